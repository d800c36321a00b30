#include "tools/io/soup.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <span>

#include "tools/io/mesh_format.h"
#include "tools/io/polygons.h"

namespace glcast::format {
namespace {

void require(bool right, const char* what) {
    if (!right) refuse(what);
}

void check(const Soup& soup) {
    std::size_t corners = 0;
    for (const std::uint32_t size : soup.sizes) corners += size;
    require(corners == soup.corners.size(), "its faces and their corners do not agree");
    const auto fits = [](const auto& list, std::size_t count) { return list.empty() || list.size() == count; };
    require(fits(soup.normals, soup.positions.size()) && fits(soup.colours, soup.positions.size()) &&
                fits(soup.face_colours, soup.sizes.size()) && fits(soup.corner_normals, corners) &&
                fits(soup.corner_colours, corners) && fits(soup.corner_places, corners),
            "its attributes do not fit its vertices and faces");
    for (const std::uint32_t v : soup.corners)
        if (v >= soup.positions.size())
            refuse("a face has corner " + std::to_string(v) + " of " + std::to_string(soup.positions.size()) +
                   " vertices");
    for (const glm::dvec3& p : soup.positions)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a position is not finite");
}

/// What corners of triangles get, out of lists of faces and corners.
class Corners {
  public:
    explicit Corners(const Soup& soup) : soup(soup), colours_of_faces(soup.colours.empty() && !soup.face_colours.empty()) {
        for (const glm::vec3& n : soup.corner_normals) any_normal = any_normal || std::isfinite(n.x + n.y + n.z);
    }

    /// The triangle of corners `picked` of face `face`, whose first is number `first` of all.
    void add(std::size_t face, std::size_t first, const std::array<std::uint32_t, 3>& picked) {
        const auto of = [&](const std::vector<glm::vec3>& list) {
            return std::array{list[first + picked[0]], list[first + picked[1]], list[first + picked[2]]};
        };
        if (any_normal) normals.push_back(of(soup.corner_normals));
        if (!soup.corner_colours.empty())
            colours.push_back(of(soup.corner_colours));
        else if (colours_of_faces)
            colours.push_back({soup.face_colours[face], soup.face_colours[face], soup.face_colours[face]});
    }

    Wedges wedges(Mesh& mesh) {
        if (normals.empty() && colours.empty()) return {};
        for (auto& corners : normals) // so that one without is like another
            for (glm::vec3& n : corners)
                if (!std::isfinite(n.x + n.y + n.z)) n = glm::vec3(0);
        return take_corner_values(mesh, normals, colours);
    }

  private:
    const Soup& soup;
    bool colours_of_faces, any_normal = false;
    CornerValues normals, colours;
};

template <class T> void put(std::string& out, const std::vector<T>& list) {
    const std::uint64_t count = list.size();
    out.append(reinterpret_cast<const char*>(&count), sizeof count);
    if (count > 0) out.append(reinterpret_cast<const char*>(list.data()), count * sizeof(T));
}

template <class T> void take(std::string_view& bytes, std::vector<T>& list) {
    std::uint64_t count = 0;
    require(bytes.size() >= sizeof count, "the reader stopped in the middle");
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes.remove_prefix(sizeof count);
    require(count <= bytes.size() / sizeof(T), "the reader stopped in the middle");
    list.resize(count);
    if (count > 0) std::memcpy(list.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
}

} // namespace

Level level_of(Soup&& soup) {
    check(soup);
    Level level;
    level.name = "level 0";
    Mesh& mesh = level.mesh;
    mesh.normals = std::move(soup.normals);
    Corners by_corner(soup);
    const std::span<const std::uint32_t> corners = soup.corners;
    std::vector<std::array<std::uint32_t, 3>> picked;
    std::size_t first = 0;
    for (std::size_t f = 0; f < soup.sizes.size(); first += soup.sizes[f], ++f) {
        picked.clear();
        const auto polygon = corners.subspan(first, soup.sizes[f]);
        cut_polygon(soup.positions, polygon, picked);
        for (const auto& t : picked) {
            mesh.triangles.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
            by_corner.add(f, first, t);
        }
    }
    mesh.positions = std::move(soup.positions);
    mesh.colours = std::move(soup.colours);
    level.wedges = by_corner.wedges(mesh);
    return level;
}

void scale_colours(std::vector<glm::vec3>& colours, bool whole) {
    float brightest = 0;
    for (const glm::vec3& c : colours) brightest = std::max({brightest, c.x, c.y, c.z});
    const float scale = brightest > 255 && brightest <= 65535 ? 65535 : whole || brightest > 1 ? 255 : 1;
    for (glm::vec3& c : colours) c /= scale;
}

std::string bytes_of(const Soup& soup) {
    std::string out;
    put(out, soup.positions), put(out, soup.sizes), put(out, soup.corners);
    put(out, soup.normals), put(out, soup.colours), put(out, soup.face_colours);
    put(out, soup.corner_normals), put(out, soup.corner_colours), put(out, soup.corner_places);
    return out;
}

Soup soup_of(std::string_view bytes) {
    Soup soup;
    take(bytes, soup.positions), take(bytes, soup.sizes), take(bytes, soup.corners);
    take(bytes, soup.normals), take(bytes, soup.colours), take(bytes, soup.face_colours);
    take(bytes, soup.corner_normals), take(bytes, soup.corner_colours), take(bytes, soup.corner_places);
    require(bytes.empty(), "the reader stopped in the middle");
    return soup;
}

} // namespace glcast::format
