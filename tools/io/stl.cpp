// .stl, ASCII and binary; corners at the same place become one vertex.
#include <array>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

using Key = std::array<std::uint64_t, 3>;
struct KeyHash {
    std::size_t operator()(const Key& k) const {
        std::uint64_t h = 0;
        for (std::uint64_t part : k) h = (h ^ part) * 0x9e3779b97f4a7c15u, h ^= h >> 32;
        return h;
    }
};

struct Welder {
    Mesh mesh;
    std::unordered_map<Key, std::uint32_t, KeyHash> seen;

    std::uint32_t vertex(glm::dvec3 p) {
        p += 0.0; // -0 is 0
        const Key key = {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                         std::bit_cast<std::uint64_t>(p.z)};
        const auto [found, is_new] = seen.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(p);
        return found->second;
    }
    void triangle(const std::array<glm::dvec3, 3>& corners) {
        mesh.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
    }
};

constexpr std::size_t binary_head = 84, binary_triangle = 50;

std::uint32_t binary_count(std::string_view bytes) {
    std::uint32_t count;
    std::memcpy(&count, bytes.data() + binary_head - 4, 4);
    return count;
}

Mesh read_binary(std::string_view bytes) {
    Welder welder;
    const std::uint32_t count = binary_count(bytes);
    for (std::uint32_t k = 0; k < count; ++k) {
        float values[12]; // normal, then three corners
        std::memcpy(values, bytes.data() + binary_head + std::size_t(k) * binary_triangle, sizeof values);
        std::array<glm::dvec3, 3> corners;
        for (int c = 0; c < 3; ++c) corners[c] = {values[3 + 3 * c], values[4 + 3 * c], values[5 + 3 * c]};
        welder.triangle(corners);
    }
    return std::move(welder.mesh);
}

Mesh read_ascii(std::string_view bytes) {
    TextCursor cursor(bytes);
    Welder welder;
    std::array<glm::dvec3, 3> corners;
    int corner = 0;
    bool ended = false;
    std::string_view line;
    while (cursor.next_full_line(line, '\0')) {
        const std::string_view what = TextCursor::word(line);
        if (what == "endsolid") ended = true;
        if (what == "endfacet" && corner != 3) cursor.fail("a facet has not three corners");
        if (what == "facet") corner = 0, ended = false;
        if (what != "vertex") continue;
        if (corner == 3) cursor.fail("a facet has more than three corners");
        for (int k = 0; k < 3; ++k) corners[corner][k] = cursor.number_on<double>(line, "a coordinate");
        if (++corner == 3) welder.triangle(corners);
    }
    if (!ended) refuse("the file is truncated");
    return std::move(welder.mesh);
}

} // namespace

std::vector<Level> read_stl(std::string_view bytes, const std::filesystem::path&) {
    // Binary files may begin with "solid" too, so their length decides.
    if (bytes.size() >= binary_head &&
        bytes.size() == binary_head + std::size_t(binary_count(bytes)) * binary_triangle)
        return one_level(read_binary(bytes));
    if (!bytes.starts_with("solid")) refuse("is no STL file, or truncated");
    return one_level(read_ascii(bytes));
}

} // namespace glcast::format
