// .stl, ASCII and binary: read by OpenMesh, which makes corners at one place one vertex and leaves out facets without area. Ours: which of
// both it is, the text in the words that OpenMesh knows, digits of doubles, and the colours that some programs hide in it.
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "tools/io/mesh_format.h"
#include "tools/io/openmesh_reader.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

constexpr std::size_t binary_head = 84, binary_facet = 50;
constexpr glm::vec3 no_colour(0.8f);

std::uint32_t binary_count(std::string_view bytes) {
    std::uint32_t count;
    std::memcpy(&count, bytes.data() + binary_head - 4, 4);
    return count;
}

struct Facet {
    float normal[3], corners[3][3];
    std::uint16_t attribute;
};

Facet facet_at(std::string_view bytes, std::size_t number) {
    Facet facet;
    const char* const at = bytes.data() + binary_head + number * binary_facet;
    std::memcpy(facet.normal, at, 12);
    std::memcpy(facet.corners, at + 12, 36);
    std::memcpy(&facet.attribute, at + 48, 2);
    return facet;
}

/// Five bits each, from `first` on in steps of `step`.
glm::vec3 bits(std::uint16_t attribute, int first, int step) {
    glm::vec3 colour;
    for (int k = 0; k < 3; ++k) colour[k] = float((attribute >> (first + k * step)) & 31) / 31;
    return colour;
}

/// Of facets that have an area, as OpenMesh counts them. Magics: "COLOR=rgba" in the head, a facet's own colour where bit 15 is off,
/// red lowest. VisCAM and SolidView: where bit 15 is on, blue lowest. Empty where the file has none.
std::vector<glm::vec3> facet_colours(std::string_view bytes) {
    const std::size_t magics = bytes.substr(0, 80).find("COLOR=");
    glm::vec3 whole = no_colour;
    if (magics <= 80 - 10)
        for (int k = 0; k < 3; ++k) whole[k] = float(static_cast<unsigned char>(bytes[magics + 6 + std::size_t(k)])) / 255;
    std::vector<glm::vec3> colours;
    bool any = magics <= 80 - 10;
    for (std::size_t n = 0; n < binary_count(bytes); ++n) {
        const Facet f = facet_at(bytes, n);
        const auto same = [&](int a, int b) { return std::equal(f.corners[a], f.corners[a] + 3, f.corners[b]); };
        if (same(0, 1) || same(1, 2) || same(2, 0)) continue;
        const bool own = (f.attribute & 0x8000) != 0;
        any = any || own;
        if (magics <= 80 - 10)
            colours.push_back(own ? whole : bits(f.attribute, 0, 5));
        else
            colours.push_back(own ? bits(f.attribute, 10, -5) : no_colour);
    }
    return any ? colours : std::vector<glm::vec3>();
}

Level read_binary(std::string_view bytes) {
    const std::size_t count = binary_count(bytes);
    for (std::size_t n = 0; n < count; ++n) {
        const Facet facet = facet_at(bytes, n);
        for (const auto& corner : facet.corners)
            for (const float value : corner)
                if (!std::isfinite(value)) refuse("a position is not finite"); // OpenMesh sorts them
    }
    Soup soup = read_with_openmesh(bytes.substr(0, binary_head + count * binary_facet), OpenMeshKind::stl_binary);
    std::vector<glm::vec3> colours = facet_colours(bytes);
    if (colours.size() == soup.sizes.size()) soup.face_colours = std::move(colours);
    return level_of(std::move(soup));
}

std::string small(std::string_view word) {
    std::string letters(word);
    for (char& c : letters) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
}

/// Corners of all facets, three each. Words may stand on any lines; names of solids end with theirs.
std::vector<glm::dvec3> text_corners(std::string_view bytes) {
    TextCursor cursor(bytes);
    std::vector<glm::dvec3> corners;
    std::size_t of_facet = 3;
    bool ended = false, end = false;
    glm::dvec3 p;
    int missing = 0; // numbers of a vertex
    std::string_view line;
    while (cursor.next_full_line(line, '\0'))
        for (std::string_view word = TextCursor::word(line); !word.empty(); word = TextCursor::word(line)) {
            if (missing > 0) {
                if (!TextCursor::parse(word, p[3 - missing])) cursor.fail("a coordinate is no number");
                if (--missing == 0) corners.push_back(p);
                continue;
            }
            const std::string what = small(word);
            const bool closes = end || what.starts_with("end");
            const std::string_view which = what == "end" ? "" : std::string_view(what).substr(what.starts_with("end") ? 3 : 0);
            end = what == "end";
            if (which == "solid") {
                ended = closes;
                line = {};
            } else if (which == "facet") {
                if (closes && of_facet != 3) cursor.fail("a facet has not three corners");
                if (!closes) of_facet = 0, ended = false;
            } else if (which == "vertex" && !closes) {
                if (++of_facet > 3) cursor.fail("a facet has more than three corners");
                missing = 3;
            }
        }
    if (!ended || missing > 0 || of_facet != 3) refuse("the file is truncated");
    return corners;
}

/// As OpenMesh understands it.
std::string plain_text(const std::vector<glm::dvec3>& corners) {
    std::string text = "solid\n";
    text.reserve(corners.size() * 48);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (k % 3 == 0) text += "facet normal 0 0 0\nouter loop\n";
        text += "vertex";
        for (int c = 0; c < 3; ++c) {
            char word[32];
            text.append(" ").append(word, std::to_chars(word, word + sizeof word, static_cast<float>(corners[k][c])).ptr);
        }
        text += k % 3 == 2 ? "\nendloop\nendfacet\n" : "\n";
    }
    return text += "endsolid\n";
}

using Key = std::array<std::uint64_t, 3>;
struct KeyHash {
    std::size_t operator()(const Key& k) const {
        std::uint64_t h = 0;
        for (std::uint64_t part : k) h = (h ^ part) * 0x9e3779b97f4a7c15u, h ^= h >> 32;
        return h;
    }
};

/// For a mesh that floats would tear.
Mesh join_doubles(const std::vector<glm::dvec3>& corners) {
    Mesh mesh;
    std::unordered_map<Key, std::uint32_t, KeyHash> seen;
    Triangle triangle{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 p = corners[k] + 0.0; // -0 is 0
        const Key key = {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)};
        const auto [found, is_new] = seen.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(p);
        triangle[k % 3] = found->second;
        if (k % 3 == 2 && triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
            mesh.triangles.push_back(triangle);
    }
    return mesh;
}

Level read_text(std::string_view bytes) {
    const std::vector<glm::dvec3> corners = text_corners(bytes);
    for (const glm::dvec3& p : corners)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a position is not finite");
    Mesh bounds;
    bounds.positions = corners;
    if (needs_doubles(bounds)) return {join_doubles(corners), "level 0"};
    return level_of(read_with_openmesh(plain_text(corners), OpenMeshKind::stl_text));
}

/// Binary files may begin with "solid" too.
bool is_text(std::string_view bytes) {
    std::string_view start = bytes.substr(0, 1u << 16);
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    if (small(start.substr(0, 5)) != "solid") return false;
    const std::string letters = small(start);
    return letters.find("facet") != letters.npos || letters.find("endsolid") != letters.npos ||
           letters.find("end solid") != letters.npos;
}

} // namespace

std::vector<Level> read_stl(std::string_view bytes, const std::filesystem::path&) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    const std::size_t facets = bytes.size() < binary_head ? 0 : (bytes.size() - binary_head) / binary_facet;
    const bool fits = bytes.size() >= binary_head && binary_count(bytes) <= facets;
    if (fits && bytes.size() == binary_head + std::size_t(binary_count(bytes)) * binary_facet)
        return {read_binary(bytes)};
    if (is_text(bytes)) return {read_text(bytes)};
    if (!fits || binary_count(bytes) == 0) refuse("is no STL file, or truncated");
    return {read_binary(bytes)}; // some programs append to it
}

} // namespace glcast::format
