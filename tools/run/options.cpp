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
#include "capture/view.h"
#include "tools/io/mesh_endings.h"
#include "tools/run/mesh_options.h"
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
        return good ? std::string()
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

void declare(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output,
                   "Capture (.exr), or mesh to make of it (" + listed_mesh_endings() +
                       "); default: PROGRAM.exr here")
        ->envname("GLCAST_OUT");
    app.add_option("-n,--resolution", o.n, "Samples along each axis")
        ->envname("GLCAST_N")
        ->check(CLI::Range(min_resolution, max_resolution))
        ->capture_default_str();
    auto* frame = app.add_option("--frame", o.frame,
                                 "Cast frame N, counted from 1 (default: the first with solid geometry)")
                      ->envname("GLCAST_FRAME")
                      ->check(CLI::Range(1L, 1'000'000'000L));
    app.add_option("--after", o.after_seconds, "Cast what stands in the window after so many seconds, or the next frame")
        ->envname("GLCAST_AFTER")
        ->check(seconds_from(0))
        ->excludes(frame);
    app.add_option("--key", o.key, "Cast a frame each time this key (F12, Print, x, ...) is pressed")
        ->envname("GLCAST_KEY")
        ->check(check_key);
    app.add_option("--signal", o.signal, "Cast a frame each time this signal (USR1, ...) comes to PROGRAM")
        ->envname("GLCAST_SIGNAL")
        ->check(check_signal);
    app.add_flag("--nudge", o.nudge, "Expose, resize and remap the window while no frame comes")
        ->envname("GLCAST_NUDGE");
    app.add_option("--every", o.every, "Cast every Nth frame from then on (%f in -o is the frame's number)")
        ->envname("GLCAST_EVERY")
        ->check(CLI::Range(1L, 1'000'000'000L));
    app.add_option(
           "--captures", o.captures,
           "Cast so many frames (default: 1; with --every, --key and --signal no limit, but 1 with --quit)")
        ->envname("GLCAST_CAPTURES")
        ->check(CLI::Range(1L, 1'000'000'000L));
    app.add_option("--normals", o.normals,
                   "signed: one render; six: the paper's six renders; of a mesh also drawn or geometric")
        ->envname("GLCAST_NORMALS")
        ->check(CLI::IsMember({"signed", "six", "drawn", "geometric"}))
        ->capture_default_str();
    app.add_option(
           "--layers", o.layers,
           "auto: all hits of each ray; K: at most K, 1 for the six views alone; slab: by clip planes")
        ->envname("GLCAST_LAYERS")
        ->check(check_layers)
        ->capture_default_str();
    app.add_option("--box", o.box, "x0,y0,z0,x1,y1,z1 in the capture frame (default: found by drawing)")
        ->envname("GLCAST_BOX")
        ->check(check_box);
    app.add_option("--frame-matrix", o.frame_matrix,
                   "eye, base or 16 numbers, column by column: eye space to capture frame")
        ->envname("GLCAST_FRAME_MATRIX")
        ->check(check_frame_matrix);
    app.add_option("--group", o.group, "Cast group K of --list (default: the one with most triangles)")
        ->envname("GLCAST_GROUP")
        ->check(CLI::Range(1, 1'000'000));
    app.add_option(
           "--window", o.window,
           "Cast this window alone: its number or title in --list, or its X id, 0x...; default: the one "
           "that shows most")
        ->envname("GLCAST_WINDOW");
    app.add_flag("--list", o.list,
                 "Print the groups of the frame instead of casting it, then end the program; "
                 "--list FILE.png also shows them");
    app.add_option(list_picture_option, o.list_picture)->group("");
    app.add_option("--include", o.include, "Also cast lines, points or lines,points, a sample thick")
        ->envname("GLCAST_INCLUDE")
        ->check(CLI::IsMember({"lines", "points", "lines,points"}));
    app.add_option("--transparent", o.transparent,
                   "What is blended: keep or skip all of it (default: keep it where half or less of what is "
                   "behind shows)")
        ->envname("GLCAST_TRANSPARENT")
        ->check(CLI::IsMember({"keep", "skip"}));
    app.add_option("--backdrop", o.backdrop,
                   "keep: cast skies, pictures behind the scene and outlines too (default: left out, with a "
                   "line that says so)")
        ->envname("GLCAST_BACKDROP")
        ->check(CLI::IsMember({"keep"}));
    app.add_option(
           "--fov", o.view_angle,
           "Field of view from bottom to top, in degrees, of a program that hands over clip coordinates")
        ->envname("GLCAST_FOV")
        ->check(from_to("degrees", 0.001, 179.999));
    app.add_flag("--headless", o.headless, "Run under an X server of its own, with software GL");
    app.add_flag("--quit", o.quit, "End the program after the capture")->envname("GLCAST_QUIT");
    app.add_option("--timeout", o.timeout_seconds,
                   "Give up and end the program after so many seconds (default: " +
                       std::to_string(static_cast<int>(default_quit_timeout_seconds)) +
                       " with --quit or --headless, else never)")
        ->check(seconds_from(0.001));
    app.add_option("--max-seconds", o.most_seconds,
                   "Give up a cast that takes longer, and let the program run on (default: never)")
        ->envname("GLCAST_MAX_SECONDS")
        ->check(seconds_from(0.001));
    app.add_flag("--keep-capture", o.keep_capture, "Of a mesh: keep the capture too, beside it, as .exr");
    app.add_flag("--verbose", o.verbose, "Say also how, with figures");
    app.add_flag(
        "--json", o.json,
        "Print one JSON object on standard output; what PROGRAM prints there goes to standard error");
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
        options.output = std::filesystem::path(options.program[0]).filename().string() +
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
        {"GLCAST_OUT", capture},
        {"GLCAST_N", std::to_string(o.n)},
        {"GLCAST_FRAME", o.frame > 0 ? std::to_string(o.frame) : ""},
        {"GLCAST_KEY", o.key},
        {"GLCAST_SIGNAL", o.signal},
        {"GLCAST_NUDGE", o.nudge ? "1" : ""},
        {"GLCAST_EVERY", o.every > 0 ? std::to_string(o.every) : ""},
        {"GLCAST_CAPTURES", std::to_string(o.captures)},
        {"GLCAST_AFTER", o.after_seconds > 0 ? in_digits(o.after_seconds) : ""},
        {"GLCAST_NORMALS", o.normals},
        {"GLCAST_LAYERS", o.layers},
        {"GLCAST_BOX", o.box},
        {"GLCAST_FRAME_MATRIX", o.frame_matrix},
        {"GLCAST_WINDOW", o.window},
        {"GLCAST_GROUP", o.group > 0 ? std::to_string(o.group) : ""},
        {"GLCAST_LIST", !o.list_picture.empty() ? o.list_picture
                        : o.list                ? "1"
                                                : ""},
        {"GLCAST_INCLUDE", o.include},
        {"GLCAST_TRANSPARENT", o.transparent},
        {"GLCAST_BACKDROP", o.backdrop},
        {"GLCAST_FOV", o.view_angle > 0 ? in_digits(o.view_angle) : ""},
        {"GLCAST_QUIT", o.quit ? "1" : ""},
        {"GLCAST_MAX_SECONDS", o.most_seconds > 0 ? in_digits(o.most_seconds) : ""},
        {"GLCAST_VERBOSE", o.verbose ? "1" : ""},
        {"GLCAST_STATUS", status_pipe},
    };
}

} // namespace glcast::run
