// .stl, written: binary, coordinates in millimetres.
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_set>

#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

struct PlaceHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::size_t h = 0;
        for (int k = 0; k < 3; ++k) h = (h ^ std::hash<float>()(p[k])) * 0x9e3779b97f4a7c15u, h ^= h >> 32;
        return h;
    }
};

/// Readers make one vertex of all corners at a place, so no two vertices may have one: the later takes the next float beside it.
std::vector<glm::vec3> apart(const Mesh& mesh, const glm::dvec3& from, double scale) {
    std::vector<glm::vec3> places;
    places.reserve(mesh.positions.size());
    std::unordered_set<glm::vec3, PlaceHash> taken(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) {
        glm::vec3 place((p - from) * scale + 0.0); // -0 is 0
        while (!taken.insert(place).second) place.x = std::nextafter(place.x, INFINITY);
        places.push_back(place);
    }
    return places;
}

} // namespace

bool write_stl(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions& options) {
    const Mesh& mesh = level.mesh;
    Gather out(files.mesh(path));
    const glm::dvec3 from = origin_of_floats(mesh);
    const std::vector<glm::vec3> places = apart(mesh, from, length_units[options.units].millimetres);
    std::string head = "glcast " GLCAST_VERSION; // must not begin with "solid"
    if (from != glm::dvec3(0)) head += ", moved by " + moved_by(from);
    head.resize(80, ' ');
    out << head;
    out.bytes(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 a = places[t[0]], b = places[t[1]], c = places[t[2]], area = glm::cross(b - a, c - a);
        const double size = glm::length(area);
        out.bytes(size > 0 ? glm::vec3(area / size) : glm::vec3(0));
        for (const std::uint32_t v : t) out.bytes(places[v]);
        out.bytes(std::uint16_t(0));
    }
    return out.flush();
}

} // namespace glcast::format
