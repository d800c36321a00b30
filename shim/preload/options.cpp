#include "shim/preload/options.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "capture/key_names.h"
#include "capture/option_table.h"
#include "capture/output_name.h"
#include "capture/reference_views.h"
#include "shim/preload/similarity.h"
#include "shim/preload/start.h"

namespace glcast::preload {
namespace {

/// from_chars, because strtod follows the program's locale.
template <class Number> bool parse_number(const std::string& text, Number& number) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && stop == end;
}

/// Numbers between commas or spaces; empty when anything else is there.
std::vector<double> parse_list(const std::string& text) {
    std::vector<double> numbers;
    std::size_t at = 0;
    while ((at = text.find_first_not_of(", ", at)) != std::string::npos) {
        const std::size_t end = std::min(text.find_first_of(", ", at), text.size());
        double number = 0;
        if (!parse_number(text.substr(at, end - at), number) || !std::isfinite(number)) return {};
        numbers.push_back(number);
        at = end;
    }
    return numbers;
}

bool parse_switch(const std::string& text, bool& on) {
    on = text == "1" || text == "yes" || text == "true";
    return on || text == "0" || text == "no" || text == "false";
}

/// GL works in floats: it has no numbers beyond, and cannot tell the samples of a smaller box apart.
constexpr double farthest_box = 1e30, smallest_box = 1e-6;

bool parse_box(const std::string& text, Options& options) {
    const std::vector<double> v = parse_list(text);
    if (v.size() != 6) return false;
    const glm::dvec3 a(v[0], v[1], v[2]), b(v[3], v[4], v[5]);
    const glm::dvec3 size = b - a;
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) return false;
    const double edge = std::max({size.x, size.y, size.z});
    const double far = std::max({-a.x, -a.y, -a.z, b.x, b.y, b.z});
    if (far > farthest_box || edge < far * smallest_box) return false;
    options.box = Box{(a + b - edge) / 2.0, edge};
    return true;
}

bool parse_frame_matrix(const std::string& text, Options& options) {
    if (text == "eye" || text == "base") {
        options.frame_matrix = text == "eye" ? FrameMatrix::eye : FrameMatrix::base;
        return true;
    }
    const std::vector<double> v = parse_list(text);
    if (v.size() != 16) return false;
    options.frame_matrix = FrameMatrix::given;
    options.given_matrix = glm::make_mat4(v.data());
    return is_similarity(options.given_matrix);
}

bool parse_normals(const std::string& text, Options& options) {
    options.normals = text == "six" ? NormalMethod::six_lights : NormalMethod::signed_lights;
    return text == "six" || text == "signed";
}

bool parse_layers(const std::string& text, Options& options) {
    if (text == "auto") return true;
    if (text == "slab") {
        options.layer_method = LayerMethod::slab;
        return true;
    }
    return parse_number(text, options.most_layers) && options.most_layers >= 1 &&
           options.most_layers <= max_layers;
}

bool parse_list_option(const std::string& text, Options& options) {
    options.list = text.ends_with(".png");
    if (!options.list) return parse_switch(text, options.list);
    options.list_picture = text;
    return true;
}

bool parse_include(const std::string& text, Options& options) {
    options.include = {.lines = text.starts_with("lines"), .points = text.ends_with("points")};
    return text == "lines" || text == "points" || text == "lines,points";
}

bool parse_transparent(const std::string& text, Options& options) {
    options.transparent = text == "keep" ? Transparent::keep : Transparent::skip;
    return text == "keep" || text == "skip";
}

bool parse_view_angle(const std::string& text, Options& options) {
    double degrees = 0;
    if (!parse_number(text, degrees) || !(degrees > 0 && degrees < 180)) return false;
    options.view_angle = degrees;
    return true;
}

bool parse_mask(const std::string& text, Options& options) {
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string part = text.substr(at, end - at);
        if (part == "float")
            options.mask.floats = true;
        else if (part == "fbo")
            options.mask.framebuffers = true;
        else if (part == "queries")
            options.mask.queries = true;
        else if (part == "glsl")
            options.use_shaders = false;
        else
            return false;
        at = end + 1;
    }
    return true;
}

/// As they were published.
constexpr std::pair<const char*, GlVersion> pretended_versions[] = {
    {"1.0", {1, 0}}, {"1.1", {1, 1}}, {"1.2", {1, 2}}, {"1.3", {1, 3}},
    {"1.4", {1, 4}}, {"1.5", {1, 5}}, {"2.0", {2, 0}}, {"2.1", {2, 1}}};

bool parse_pretend(const std::string& text, Options& options) {
    for (const auto& [name, version] : pretended_versions)
        if (text == name) options.pretend = version;
    return options.pretend.has_value();
}

/// How each variable beside GLCAST_OUT is read; capture/option_table.h says what it may hold.
struct Variable {
    const CastOption& option;
    bool (*parse)(const std::string& text, Options& options);
};
constexpr Variable variables[] = {
    {cast_option("GLCAST_N"),
     [](const std::string& t, Options& o) {
         return parse_number(t, o.n) && o.n >= min_resolution && o.n <= max_resolution;
     }},
    {cast_option("GLCAST_FRAME"),
     [](const std::string& t, Options& o) { return parse_number(t, o.frame) && o.frame >= 1; }},
    {cast_option("GLCAST_EVERY"),
     [](const std::string& t, Options& o) { return parse_number(t, o.every) && o.every >= 1; }},
    {cast_option("GLCAST_CAPTURES"),
     [](const std::string& t, Options& o) { return parse_number(t, o.captures) && o.captures >= 0; }},
    {cast_option("GLCAST_KEY"),
     [](const std::string& t, Options& o) {
         o.key = t;
         return (o.key_symbol = key_symbol(t)) != 0;
     }},
    {cast_option("GLCAST_SIGNAL"),
     [](const std::string& t, Options& o) { return (o.signal = signal_number(t)) != 0; }},
    {cast_option("GLCAST_NUDGE"), [](const std::string& t, Options& o) { return parse_switch(t, o.nudge); }},
    {cast_option("GLCAST_AFTER"),
     [](const std::string& t, Options& o) {
         return parse_number(t, o.after_seconds) && std::isfinite(o.after_seconds) && o.after_seconds >= 0;
     }},
    {cast_option("GLCAST_NORMALS"), parse_normals},
    {cast_option("GLCAST_LAYERS"), parse_layers},
    {cast_option("GLCAST_SHADERS"),
     [](const std::string& t, Options& o) { return parse_switch(t, o.use_shaders); }},
    {cast_option("GLCAST_REPLAY"),
     [](const std::string& t, Options& o) {
         o.prepare_replay = t == "arrays";
         return o.prepare_replay || t == "calls";
     }},
    {cast_option("GLCAST_BOX"), parse_box},
    {cast_option("GLCAST_FRAME_MATRIX"), parse_frame_matrix},
    {cast_option("GLCAST_LIST"), parse_list_option},
    {cast_option("GLCAST_INCLUDE"), parse_include},
    {cast_option("GLCAST_TRANSPARENT"), parse_transparent},
    {cast_option("GLCAST_BACKDROP"),
     [](const std::string& t, Options& o) { return o.keep_backdrops = t == "keep"; }},
    {cast_option("GLCAST_FOV"), parse_view_angle},
    {cast_option("GLCAST_GROUP"),
     [](const std::string& t, Options& o) { return parse_number(t, o.group) && o.group >= 1; }},
    {cast_option("GLCAST_REFERENCE_VIEWS"),
     [](const std::string& t, Options& o) {
         return parse_number(t, o.reference_views) && o.reference_views >= 1 &&
                o.reference_views <= max_reference_views && !o.box;
     }},
    {cast_option("GLCAST_REFERENCE_N"),
     [](const std::string& t, Options& o) {
         return parse_number(t, o.reference_n) && o.reference_n >= min_resolution &&
                o.reference_n <= max_resolution;
     }},
    {cast_option("GLCAST_WINDOW"), [](const std::string& t, Options& o) { return !(o.window = t).empty(); }},
    {cast_option("GLCAST_MASK"), parse_mask},
    {cast_option("GLCAST_MEMORY"),
     [](const std::string& t, Options& o) { return parse_number(t, o.memory_mib) && o.memory_mib >= 1; }},
    {cast_option("GLCAST_MAX_SECONDS"),
     [](const std::string& t, Options& o) {
         return parse_number(t, o.most_seconds) && std::isfinite(o.most_seconds) && o.most_seconds > 0;
     }},
    {cast_option("GLCAST_READ_ENDS"),
     [](const std::string& t, Options& o) { return parse_switch(t, o.read_ends); }},
    {cast_option("GLCAST_PRETEND"), parse_pretend},
    {cast_option("GLCAST_QUIT"), [](const std::string& t, Options& o) { return parse_switch(t, o.quit); }},
};

/// GLCAST_OUT is read below, the others by glcast-run and where lines are written.
constexpr std::string_view read_elsewhere[] = {"", "GLCAST_OUT", "GLCAST_LIBRARY", "GLCAST_VERBOSE"};

consteval bool all_are_read() {
    for (const CastOption& option : cast_options) {
        const auto is_same = [&](const Variable& v) { return v.option.variable == option.variable; };
        if (std::ranges::none_of(variables, is_same) &&
            std::ranges::find(read_elsewhere, option.variable) == std::end(read_elsewhere))
            return false;
    }
    return true;
}
static_assert(all_are_read(), "a variable of capture/option_table.h that nothing reads");

/// Why a file could not be written there, found before the program has drawn anything.
std::string check_output(const std::string& out) {
    const std::filesystem::path path(out);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::error_code ignored;
    if (is_pattern(folder)) return "cannot write " + out + ": %p and %f may stand in the file's name only";
    if (!std::filesystem::is_directory(folder, ignored))
        return "cannot write " + out + ": no folder " + folder.string();
    if (std::filesystem::is_directory(path, ignored)) return "cannot write " + out + ": it is a folder";
    if (std::filesystem::is_other(path, ignored))
        return "cannot write " + out + ": it is a device, a pipe or a socket";
    if (access(folder.c_str(), W_OK) != 0) return "cannot write " + out + ": " + std::strerror(errno);
    return {};
}

} // namespace

namespace {
bool is_set(const char* name) {
    const char* text = std::getenv(name);
    return text && *text;
}
} // namespace

Options read_options() {
    Options options;
    for (const Variable& variable : variables) {
        const char* text = std::getenv(variable.option.variable);
        if (!text || !*text || variable.parse(text, options)) continue;
        options.error =
            std::string(variable.option.variable) + "=" + text + ": expected " + variable.option.expected;
        return options;
    }
    if (options.captures < 0) {
        const bool repeats = is_set("GLCAST_EVERY") || !options.key.empty() || options.signal;
        options.captures = repeats && !options.quit ? 0 : 1;
    }
    const char* out = std::getenv("GLCAST_OUT");
    options.out = absolute_at_start(out ? out : "");
    options.list_picture = absolute_at_start(options.list_picture);
    const std::string& file = options.list ? options.list_picture : options.out;
    if (!file.empty()) options.error = check_output(file);
    if (!options.list && !file.empty() && options.error.empty() && !file.ends_with(".exr"))
        options.error = "cannot write " + file + ": a capture is named .exr; glcast-run -o makes meshes";
    options.armed = options.error.empty() && (options.list || !options.out.empty());
    return options;
}

} // namespace glcast::preload
