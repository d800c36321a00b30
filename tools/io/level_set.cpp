#include "tools/io/level_set.h"

#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace glcast {
namespace {

constexpr std::size_t mark_within = 65'536; // bytes of a file
constexpr int most_digits = 16;

/// FNV-1a by words.
void mix(std::uint64_t& hash, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    for (std::size_t k = 0; k < bytes; k += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, from + k, std::min(sizeof word, bytes - k));
        hash = (hash ^ word) * 0x100000001b3;
        hash ^= hash >> 32;
    }
}

template <class T> bool take(std::string_view& text, T& value, int base = 10) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc()) return false;
    text.remove_prefix(std::size_t(end - text.data()));
    return true;
}

} // namespace

std::filesystem::path level_path(const std::filesystem::path& path, std::size_t level) {
    if (level == 0) return path;
    return path.parent_path() / (level_name(path, level) + path.extension().string());
}

std::string level_name(const std::filesystem::path& path, std::size_t level) {
    return path.stem().string() + "_LOD" + std::to_string(level);
}

void join_as_set(std::span<Level> levels) {
    if (levels.size() < 2) return;
    std::uint64_t id = 0xcbf29ce484222325;
    for (const Level& level : levels) {
        mix(id, level.mesh.positions.data(), level.mesh.positions.size() * sizeof(glm::dvec3));
        mix(id, level.mesh.triangles.data(), level.mesh.triangles.size() * sizeof(Triangle));
    }
    for (std::size_t k = 0; k < levels.size(); ++k)
        levels[k].set = {id, unsigned(k), unsigned(levels.size())};
}

std::string mark_of(const LevelSet& set) {
    if (set.count == 0) return "";
    char text[64];
    std::snprintf(text, sizeof text, "%0*" PRIx64 " %u/%u", most_digits, set.id, set.level, set.count);
    return text;
}

LevelSet marked_set(std::string_view bytes) {
    bytes = bytes.substr(0, mark_within);
    const std::size_t at = bytes.find(mark_name);
    if (at == bytes.npos) return {};
    bytes.remove_prefix(at + std::strlen(mark_name));
    bytes.remove_prefix(std::min(bytes.find_first_not_of("\": "), bytes.size()));
    LevelSet set;
    if (!take(bytes, set.id, 16) || !bytes.starts_with(' ')) return {};
    bytes.remove_prefix(1);
    if (!take(bytes, set.level) || !bytes.starts_with('/')) return {};
    bytes.remove_prefix(1);
    return take(bytes, set.count) && set.level < set.count ? set : LevelSet{};
}

LevelSet set_of_file(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    std::ifstream file(path, std::ios::binary);
    std::string bytes(mark_within, '\0');
    file.read(bytes.data(), std::streamsize(bytes.size()));
    return marked_set(std::string_view(bytes).substr(0, std::size_t(file.gcount())));
}

std::vector<std::filesystem::path> levels_beside(const std::filesystem::path& path, const LevelSet& set) {
    constexpr unsigned most = 64; // a mark may say anything
    std::vector<std::filesystem::path> found;
    if (set.level != 0) return found;
    for (unsigned k = 1; k < std::min(set.count, most); ++k) {
        const std::filesystem::path beside = level_path(path, k);
        if (const LevelSet other = set_of_file(beside);
            other.id == set.id && other.level == k && other.count == set.count)
            found.push_back(beside);
    }
    return found;
}

} // namespace glcast
