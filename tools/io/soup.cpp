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

/// What comes corner by corner, as means or sums of vertices. Vertices without a corner get `none`.
class OfCorners {
  public:
    OfCorners(std::size_t vertices, glm::vec3 none) : sums(vertices, glm::dvec3(0)), counts(vertices, 0), none(none) {}
    void add(std::uint32_t vertex, const glm::vec3& value) {
        if (std::isfinite(value.x + value.y + value.z)) sums[vertex] += glm::dvec3(value), ++counts[vertex];
    }
    std::vector<glm::vec3> means() const {
        std::vector<glm::vec3> all(sums.size(), none);
        for (std::size_t v = 0; v < sums.size(); ++v)
            if (counts[v] > 0) all[v] = glm::vec3(sums[v] / double(counts[v]));
        return all;
    }
    bool any() const {
        return std::any_of(counts.begin(), counts.end(), [](std::uint32_t count) { return count > 0; });
    }

  private:
    std::vector<glm::dvec3> sums;
    std::vector<std::uint32_t> counts;
    glm::vec3 none;
};

void attributes_of_corners(const Soup& soup, Mesh& mesh) {
    const std::size_t vertices = soup.positions.size();
    OfCorners normals(vertices, glm::vec3(0)), colours(vertices, glm::vec3(1));
    std::size_t at = 0;
    for (std::size_t f = 0; f < soup.sizes.size(); ++f)
        for (std::uint32_t k = 0; k < soup.sizes[f]; ++k, ++at) {
            if (!soup.corner_normals.empty()) normals.add(soup.corners[at], soup.corner_normals[at]);
            if (!soup.corner_colours.empty())
                colours.add(soup.corners[at], soup.corner_colours[at]);
            else if (!soup.face_colours.empty() && mesh.colours.empty())
                colours.add(soup.corners[at], soup.face_colours[f]);
        }
    if (normals.any()) mesh.normals = normals.means();
    if (colours.any()) mesh.colours = colours.means();
}

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

Mesh mesh_of(Soup&& soup) {
    check(soup);
    Mesh mesh;
    mesh.normals = std::move(soup.normals);
    mesh.colours = std::move(soup.colours);
    attributes_of_corners(soup, mesh);
    const std::span<const std::uint32_t> corners = soup.corners;
    std::vector<std::array<std::uint32_t, 3>> picked;
    std::size_t at = 0;
    for (const std::uint32_t size : soup.sizes) {
        picked.clear();
        const auto polygon = corners.subspan(at, size);
        cut_polygon(soup.positions, polygon, picked);
        for (const auto& t : picked) mesh.triangles.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
        at += size;
    }
    mesh.positions = std::move(soup.positions);
    return mesh;
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
