#include "tools/run/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "capture/key_names.h"
#include "capture/option_table.h"
#include "capture/view.h"
#include "tools/io/mesh_endings.h"
#include "tools/run/mesh_options.h"
#include "tools/run/wine.h"
#include "tools/words/text.h"

namespace glcast::run {
namespace {

constexpr double default_quit_timeout_seconds = 120, most_seconds = 1e6;

std::optional<std::vector<double>> numbers(const std::string& text, std::size_t count) {
    std::vector<double> values;
    std::stringstream fields(text);
    for (std::string field; std::getline(fields, field, ',');) {
        std::size_t used = 0;
        double value = 0;
        try {
            value = std::stod(field, &used);
        } catch (const std::exception&) {
            return std::nullopt;
        }
        if (used != field.size() || !std::isfinite(value)) {
            return std::nullopt;
        }
        values.push_back(value);
    }
    return values.size() == count && text.back() != ',' ? std::optional(values) : std::nullopt;
}

std::string check_box(const std::string& text) {
    const auto v = numbers(text, 6);
    if (!v) {
        return "needs six numbers: x0,y0,z0,x1,y1,z1";
    }
    double edge = 0, far = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!((*v)[axis] < (*v)[axis + 3])) {
            return "x0,y0,z0 must be below x1,y1,z1";
        }
        edge = std::max(edge, (*v)[axis + 3] - (*v)[axis]);
        far = std::max({far, -(*v)[axis], (*v)[axis + 3]});
    }
    // The same bounds as in shim/preload/options.cpp: GL works in floats.
    return far > 1e30 || edge < far * 1e-6
               ? "no number may be beyond 1e30, and the corners a millionth of that apart"
               : "";
}

/// Rotation, uniform scale and translation only: anything else would bend the normals and the lattice.
bool is_similarity(const std::vector<double>& m) {
    const auto dot = [&](int a, int b) {
        return m[4 * a] * m[4 * b] + m[4 * a + 1] * m[4 * b + 1] + m[4 * a + 2] * m[4 * b + 2];
    };
    const double scale = dot(0, 0), slack = 1e-4 * scale;
    const bool affine = m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1;
    const bool orthogonal =
        std::abs(dot(0, 1)) <= slack && std::abs(dot(0, 2)) <= slack && std::abs(dot(1, 2)) <= slack;
    return affine && scale > 0 && orthogonal && std::abs(dot(1, 1) - scale) <= slack &&
           std::abs(dot(2, 2) - scale) <= slack;
}

std::string check_frame_matrix(const std::string& text) {
    if (text == "eye" || text == "base") {
        return {};
    }
    const auto m = numbers(text, 16);
    if (!m) {
        return "needs eye, base or 16 numbers with commas between, column by column";
    }
    return is_similarity(*m)
               ? ""
               : "the 16 numbers must be rotation, uniform scale and translation, column by column";
}

std::string check_layers(const std::string& text) {
    int most = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), most);
    const bool number = error == std::errc{} && stop == text.data() + text.size();
    const bool good = text == "auto" || text == "slab" || (number && most >= 1 && most <= max_layers);
    return good ? "" : "needs auto, slab or a whole number from 1 to 256, not " + text;
}

std::string check_key(const std::string& text) {
    return key_symbol(text) != 0 ? "" : "needs a key, like F12, Print or x, not " + text;
}

std::string check_signal(const std::string& text) {
    return signal_number(text) != 0
               ? ""
               : "needs a signal that does not end programs, like USR1 or RTMIN+1, not " + text;
}

std::string in_digits(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

/// CLI::Range lets "nan" through.
CLI::Validator from_to(const char* unit, double least, double most) {
    const std::string range[] = {in_digits(least), in_digits(most)};
    const auto check = [=](const std::string& text) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return good
                   ? std::string()
                   : std::string("needs ") + unit + " from " + range[0] + " to " + range[1] + ", not " + text;
    };
    return {check, "FLOAT in [" + range[0] + " - " + range[1] + "]"};
}

CLI::Validator seconds_from(double least) { return from_to("seconds", least, most_seconds); }

constexpr const char* list_picture_option = "--list-picture";

/// `--list` takes the next word when it is the name of a picture.
std::vector<std::string> split_list_option(const char* const* first, const char* const* last) {
    std::vector<std::string> words;
    for (; first != last; ++first) {
        if (!words.empty() && words.back() == "--list" && std::string_view(*first).ends_with(".png")) {
            words.emplace_back(list_picture_option);
        }
        words.emplace_back(*first);
    }
    return words;
}

class HelpFormat : public CLI::Formatter {
    std::string make_usage(const CLI::App*, std::string) const override {
        return "Usage: glcast-run [OPTIONS] -- PROGRAM [ARGS...]\n";
    }
};

/// Kept as they are, each as a word of its own: a value must not be taken for PROGRAM.
void declare_mesh_options(CLI::App& app, Options& o) {
    for (const MeshOption& option : mesh_options) {
        const std::string name = option.name, text = "As in glcast mesh, when -o is a mesh";
        if (option.takes_value)
            app.add_option_function<std::vector<std::string>>(
                   name,
                   [&o, name](const std::vector<std::string>& values) {
                       for (const std::string& value : values) o.mesh_arguments.push_back(name + "=" + value);
                   },
                   text)
                ->type_name("TEXT")
                ->expected(1)
                ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                ->group("Mesh");
        else
            app.add_flag_callback(
                   name, [&o, name] { o.mesh_arguments.push_back(name); }, text)
                ->group("Mesh");
    }
}

/// Rows of the table, with what reads them.
CLI::Option* named(CLI::Option* option, const CastOption& row) {
    return *row.variable ? option->envname(row.variable) : option;
}
template <class T> CLI::Option* value(CLI::App& app, const CastOption& row, T& target) {
    return named(app.add_option(row.names, target, row.meaning), row);
}
CLI::Option* flag(CLI::App& app, const CastOption& row, bool& target) {
    return named(app.add_flag(row.names, target, row.meaning), row);
}

void declare_when(CLI::App& app, Options& o) {
    auto* frame = value(app, cast_option("--frame"), o.frame)->check(CLI::Range(1L, 1'000'000'000L));
    value(app, cast_option("--after"), o.after_seconds)->check(seconds_from(0))->excludes(frame);
    value(app, cast_option("--key"), o.key)->check(check_key);
    value(app, cast_option("--signal"), o.signal)->check(check_signal);
    flag(app, cast_option("--nudge"), o.nudge);
    value(app, cast_option("--every"), o.every)->check(CLI::Range(1L, 1'000'000'000L));
    value(app, cast_option("--captures"), o.captures)->check(CLI::Range(1L, 1'000'000'000L));
}

void declare_how(CLI::App& app, Options& o) {
    value(app, cast_option("--normals"), o.normals)
        ->check(CLI::IsMember({"signed", "six", "drawn", "geometric"}))
        ->capture_default_str();
    value(app, cast_option("--layers"), o.layers)->check(check_layers)->capture_default_str();
    value(app, cast_option("--box"), o.box)->check(check_box);
    value(app, cast_option("--frame-matrix"), o.frame_matrix)->check(check_frame_matrix);
}

void declare_what(CLI::App& app, Options& o) {
    value(app, cast_option("--group"), o.group)->check(CLI::Range(1, 1'000'000));
    value(app, cast_option("--window"), o.window);
    // The variable may hold the name of a picture too: parse_options reads it.
    app.add_flag(cast_option("--list").names, o.list, cast_option("--list").meaning);
    app.add_option(list_picture_option, o.list_picture)->group("");
    value(app, cast_option("--include"), o.include)
        ->check(CLI::IsMember({"lines", "points", "lines,points"}));
    value(app, cast_option("--transparent"), o.transparent)->check(CLI::IsMember({"keep", "skip"}));
    value(app, cast_option("--backdrop"), o.backdrop)->check(CLI::IsMember({"keep"}));
    value(app, cast_option("--fov"), o.view_angle)->check(from_to("degrees", 0.001, 179.999));
}

void declare_run(CLI::App& app, Options& o) {
    value(app, cast_option("--pretend"), o.pretend)
        ->check(CLI::IsMember({"1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "2.0", "2.1"}));
    flag(app, cast_option("--direct3d"), o.direct3d);
    flag(app, cast_option("--headless"), o.headless);
    flag(app, cast_option("--quit"), o.quit);
    value(app, cast_option("--timeout"), o.timeout_seconds)->check(seconds_from(0.001));
    value(app, cast_option("--max-seconds"), o.most_seconds)->check(seconds_from(0.001));
    flag(app, cast_option("--keep-capture"), o.keep_capture);
    app.add_flag(cast_option("--verbose").names, o.verbose, cast_option("--verbose").meaning);
    flag(app, cast_option("--json"), o.json);
}

void declare(CLI::App& app, Options& o) {
    value(app, cast_option("--output"), o.output);
    value(app, cast_option("--resolution"), o.n)
        ->check(CLI::Range(min_resolution, max_resolution))
        ->capture_default_str();
    declare_when(app, o);
    declare_how(app, o);
    declare_what(app, o);
    declare_run(app, o);
    app.set_version_flag("--version", "glcast-run " GLCAST_VERSION);
    declare_mesh_options(app, o);
    app.footer("Exit status: 0 cast, 1 not cast (one line says why), 2 wrong usage.");
    app.formatter(std::make_shared<HelpFormat>());
    app.prefix_command();
}

Parsed usage(const std::string& what) {
    std::cerr << printable("glcast-run: " + what + " (see glcast-run --help)") << '\n';
    return Parsed::usage_error;
}

/// What the mesh options mean beside the others; empty, or what is wrong.
std::string settle_mesh(Options& o) {
    const std::filesystem::path output(o.output);
    o.makes_mesh = has_mesh_ending(output);
    if (!o.makes_mesh && output.extension() != ".exr")
        return "cannot write " + o.output + ": name it .exr for the capture, or " + listed_mesh_endings() +
               " for a mesh made of it";
    if (o.normals == "drawn" || o.normals == "geometric") {
        o.mesh_arguments.push_back("--normals=" + o.normals);
        o.normals = Options().normals;
    }
    if (o.makes_mesh || o.mesh_arguments.empty()) return {};
    const std::string& first = o.mesh_arguments[0];
    return first.substr(0, first.find('=')) + " is of a mesh: name the output " + listed_mesh_endings();
}

} // namespace

Parsed parse_options(int argc, const char* const* argv, Options& options) {
    const auto dashes = std::find(argv + std::min(argc, 1), argv + argc, std::string_view("--"));
    CLI::App app("Run PROGRAM unchanged and cast one frame of what it draws with OpenGL: a capture (.exr), "
                 "or a mesh made of it.",
                 "glcast-run");
    declare(app, options);
    try {
        auto words = split_list_option(argv + std::min(argc, 1), dashes);
        std::reverse(words.begin(), words.end()); // CLI11 takes them from the back
        app.parse(std::move(words));
    } catch (const CLI::Success& help) {
        app.exit(help);
        return Parsed::done;
    } catch (const CLI::ParseError& error) {
        return usage(error.what());
    }
    options.program = app.remaining();
    if (!options.program.empty() && options.program[0].starts_with('-')) {
        return usage("unknown option " + options.program[0]);
    }
    if (dashes != argv + argc) {
        // Without dashes of ours, those belong to the program: glcast-run prog -- x
        options.program.insert(options.program.end(), dashes + (options.program.empty() ? 1 : 0),
                               argv + argc);
    }
    if (options.program.empty()) {
        return usage("no PROGRAM given");
    }
    if (const char* list = std::getenv("GLCAST_LIST"); list != nullptr && !options.list) {
        const std::string_view text(list);
        options.list = text == "1" || text == "yes" || text == "true";
        if (text.ends_with(".png")) {
            options.list_picture = text;
        }
    }
    if (!options.list_picture.empty()) {
        options.list = true;
        options.list_picture = std::filesystem::absolute(options.list_picture);
    }
    options.quit |= options.list;
    if (options.captures < 0) {
        const bool repeats = options.every > 0 || !options.key.empty() || !options.signal.empty();
        options.captures = repeats && !options.quit ? 0 : 1;
    }
    if (options.timeout_seconds == 0 && (options.quit || options.headless)) {
        options.timeout_seconds = default_quit_timeout_seconds;
    }
    if (options.list) {
        options.output.clear();
        return Parsed::run;
    }
    if (options.output.empty()) {
        const std::filesystem::path program = shown_program(options);
        options.output = (is_wine(options) ? program.stem() : program).string() +
                         (options.captures == 1 ? ".exr" : ".%f.exr");
    }
    if (const std::string trouble = settle_mesh(options); !trouble.empty()) {
        return usage(trouble);
    }
    options.output = std::filesystem::absolute(options.output);
    return Parsed::run;
}

std::vector<std::pair<std::string, std::string>> shim_variables(const Options& o, const std::string& capture,
                                                                const std::filesystem::path& status_pipe) {
    return {
        {cast_option("GLCAST_OUT").variable, capture},
        {cast_option("GLCAST_N").variable, std::to_string(o.n)},
        {cast_option("GLCAST_FRAME").variable, o.frame > 0 ? std::to_string(o.frame) : ""},
        {cast_option("GLCAST_KEY").variable, o.key},
        {cast_option("GLCAST_SIGNAL").variable, o.signal},
        {cast_option("GLCAST_NUDGE").variable, o.nudge ? "1" : ""},
        {cast_option("GLCAST_EVERY").variable, o.every > 0 ? std::to_string(o.every) : ""},
        {cast_option("GLCAST_CAPTURES").variable, std::to_string(o.captures)},
        {cast_option("GLCAST_AFTER").variable, o.after_seconds > 0 ? in_digits(o.after_seconds) : ""},
        {cast_option("GLCAST_NORMALS").variable, o.normals},
        {cast_option("GLCAST_LAYERS").variable, o.layers},
        {cast_option("GLCAST_BOX").variable, o.box},
        {cast_option("GLCAST_FRAME_MATRIX").variable, o.frame_matrix},
        {cast_option("GLCAST_WINDOW").variable, o.window},
        {cast_option("GLCAST_GROUP").variable, o.group > 0 ? std::to_string(o.group) : ""},
        {cast_option("GLCAST_LIST").variable, !o.list_picture.empty() ? o.list_picture
                                              : o.list                ? "1"
                                                                      : ""},
        {cast_option("GLCAST_INCLUDE").variable, o.include},
        {cast_option("GLCAST_TRANSPARENT").variable, o.transparent},
        {cast_option("GLCAST_BACKDROP").variable, o.backdrop},
        {cast_option("GLCAST_FOV").variable, o.view_angle > 0 ? in_digits(o.view_angle) : ""},
        {cast_option("GLCAST_PRETEND").variable, o.pretend},
        {cast_option("GLCAST_QUIT").variable, o.quit ? "1" : ""},
        {cast_option("GLCAST_MAX_SECONDS").variable, o.most_seconds > 0 ? in_digits(o.most_seconds) : ""},
        {cast_option("GLCAST_VERBOSE").variable, o.verbose ? "1" : ""},
        {"GLCAST_STATUS", status_pipe},
    };
}

} // namespace glcast::run
