#include "tools/mesh/face_colours.h"

#include <algorithm>

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// Vertices or wedges of a part: those of the whole get numbers in the order of the whole.
std::vector<std::uint32_t> taken(const std::vector<Triangle>& triangles, const FaceColours& colours, std::uint32_t which) {
    std::vector<std::uint32_t> found;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (colours.face[t] == which) found.insert(found.end(), triangles[t].begin(), triangles[t].end());
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::vector<Triangle> renumbered(const std::vector<Triangle>& triangles, const FaceColours& colours, std::uint32_t which,
                                 const std::vector<std::uint32_t>& taken) {
    std::vector<Triangle> out;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (colours.face[t] != which) continue;
        Triangle& to = out.emplace_back();
        for (int k = 0; k < 3; ++k)
            to[k] = std::uint32_t(std::lower_bound(taken.begin(), taken.end(), triangles[t][k]) - taken.begin());
    }
    return out;
}

} // namespace

FaceColours face_colours(const Level& level) {
    if (!has_colours(level.mesh, level.wedges) || !level.texture.empty()) return {};
    FaceColours found;
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t) {
        const std::array<glm::vec3, 3> corners = corner_colours(level.mesh, level.wedges, t);
        if (corners[0] != corners[1] || corners[1] != corners[2]) return {};
        const auto at = std::find(found.palette.begin(), found.palette.end(), corners[0]);
        found.face.push_back(std::uint32_t(at - found.palette.begin()));
        if (at != found.palette.end()) continue;
        if (found.palette.size() == most_face_colours) return {};
        found.palette.push_back(corners[0]);
    }
    return found;
}

FacePart part_of_colour(const Level& level, const FaceColours& colours, std::uint32_t which) {
    FacePart part;
    const Mesh& mesh = level.mesh;
    part.vertices = taken(mesh.triangles, colours, which);
    part.mesh.triangles = renumbered(mesh.triangles, colours, which, part.vertices);
    for (const std::uint32_t v : part.vertices) {
        part.mesh.positions.push_back(mesh.positions[v]);
        if (!mesh.normals.empty()) part.mesh.normals.push_back(mesh.normals[v]);
    }
    if (level.wedges.normals.empty()) return part;
    const std::vector<std::uint32_t> wedges = taken(level.wedges.corners, colours, which);
    part.wedges.corners = renumbered(level.wedges.corners, colours, which, wedges);
    for (const std::uint32_t w : wedges) part.wedges.normals.push_back(level.wedges.normals[w]);
    return part;
}

} // namespace glcast
