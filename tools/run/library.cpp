#include "tools/run/library.h"

#include <array>
#include <cstdlib>
#include <string_view>

namespace glcast::run {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view name = "libglcast.so";
constexpr std::string_view lib = "$LIB";

/// What the loaders of the two widths put for $LIB: Debian, then Fedora and others.
struct Widths {
    std::string_view ours, other;
};
constexpr std::array widths = {Widths{"lib/x86_64-linux-gnu", "lib/i386-linux-gnu"}, Widths{"lib64", "lib"}};

bool is_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

/// `file`, and the other one where it is PREFIX/$LIB/glcast/libglcast.so.
Library with_other(const fs::path& file) {
    Library found{file, {}, {}};
    const std::string folder = file.parent_path().string();
    for (const Widths& pair : widths) {
        const std::string end = "/" + std::string(pair.ours) + "/glcast";
        if (sizeof(void*) != 8 || !folder.ends_with(end)) continue;
        const fs::path prefix = folder.substr(0, folder.size() - end.size()) + "/";
        const fs::path other = prefix / pair.other / "glcast" / name;
        if (is_file(other)) return {file, other, prefix};
    }
    return found;
}

/// GLCAST_LIBRARY with $LIB in it, as the loaders read it.
Library from_pattern(const std::string& pattern, std::size_t at) {
    for (const Widths& pair : widths) {
        const std::string before = pattern.substr(0, at);
        const std::string after = pattern.substr(at + lib.size());
        const fs::path ours = fs::absolute(before + std::string(pair.ours) + after);
        if (is_file(ours)) return with_other(ours.lexically_normal());
    }
    return {};
}

} // namespace

std::string Library::preload(const fs::path& scratch) const {
    const bool is_special = file.string().find_first_of(" :$") != std::string::npos;
    if (other.empty()) {
        if (!is_special) return file;
        fs::create_symlink(file, scratch / name);
        return scratch / name;
    }
    if (!is_special) return prefix / lib / "glcast" / name;
    fs::create_directory_symlink(prefix, scratch / "root");
    return scratch / "root" / lib / "glcast" / name;
}

Library find_library() {
    if (const char* given = std::getenv("GLCAST_LIBRARY"); given != nullptr && *given != '\0') {
        const std::string pattern = given;
        if (const std::size_t at = pattern.find(lib); at != std::string::npos)
            return from_pattern(pattern, at);
        return is_file(pattern) ? with_other(fs::absolute(pattern).lexically_normal()) : Library{};
    }
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    for (const char* folder : {"", GLCAST_SHIM_FROM_BUILD, GLCAST_SHIM_FROM_INSTALL, "../lib/glcast"}) {
        const fs::path candidate = (here / folder / name).lexically_normal();
        if (is_file(candidate)) return with_other(candidate);
    }
    return {};
}

} // namespace glcast::run
