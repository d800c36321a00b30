#include "tools/run/wine.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace glcast::run {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 6> names = {"wine",        "wine32",           "wine64",
                                                   "wine-stable", "wine-development", "wine-staging"};

bool is_set(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

} // namespace

bool is_wine(const Options& options) {
    const std::string command = fs::path(options.program[0]).filename().string();
    return std::find(names.begin(), names.end(), command) != names.end();
}

std::string shown_program(const Options& options) {
    const std::string command = fs::path(options.program[0]).filename().string();
    if (!is_wine(options)) return command;
    for (const std::string& word : options.program)
        if (lower(word).ends_with(".exe")) return word.substr(word.find_last_of("/\\:") + 1);
    return command;
}

fs::path missing_prefix(const Options& options) {
    if (!is_wine(options)) return {};
    const char* home = std::getenv("HOME");
    const fs::path prefix = is_set("WINEPREFIX") ? fs::path(std::getenv("WINEPREFIX"))
                            : home != nullptr    ? fs::path(home) / ".wine"
                                                 : fs::path();
    std::error_code ignored;
    return prefix.empty() || fs::exists(prefix / ".update-timestamp", ignored) ? fs::path() : prefix;
}

Environment prefix_variables(const std::string& display) {
    Environment changes;
    // Else it asks in a window whether to fetch its Mono and its Gecko, and waits.
    if (!is_set("WINEDLLOVERRIDES")) changes.emplace_back("WINEDLLOVERRIDES", "mscoree,mshtml=");
    if (!display.empty()) changes.insert(changes.end(), {{"DISPLAY", display}, {"WAYLAND_DISPLAY", ""}});
    return changes;
}

Environment direct3d_variables(const Options& options) {
    Environment changes;
    // Of GL 1.0, and no shaders: vertices then go by fixed functions; fragments, where the driver has no
    // extension for them, which is what the pretence is for. In the back buffer: no step more to the window.
    if (!is_set("WINE_D3D_CONFIG"))
        changes.emplace_back("WINE_D3D_CONFIG",
                             "MaxVersionGL=0x10000,shader_backend=none,OffscreenRenderingMode=backbuffer");
    if (options.pretend.empty()) changes.emplace_back("GLCAST_PRETEND", "1.5");
    return changes;
}

} // namespace glcast::run
