#include "tools/texture/colour_patches.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "tools/mesh/face_colours.h"

namespace glcast {
namespace {

constexpr float same = 2.5f / 255;    // of a channel: a plain colour, as captured in bytes and fitted
constexpr float other = 16.0f / 255;  // two colours nearer than this, and not the same, are a gradient
constexpr double on_borders = 0.08;   // of the area may be of no plain colour: triangles across borders

float difference(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

struct Face {
    glm::vec3 colour{0}; ///< mean of its corners
    double area = 0;
    bool plain = false; ///< its corners agree
};

std::vector<Face> faces_of(const Level& level) {
    const Mesh& mesh = level.mesh;
    std::vector<Face> faces(mesh.triangles.size());
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const std::array<glm::vec3, 3> c = corner_colours(mesh, level.wedges, t);
        const glm::dvec3& a = mesh.positions[mesh.triangles[t][0]];
        const glm::dvec3 u = mesh.positions[mesh.triangles[t][1]] - a, v = mesh.positions[mesh.triangles[t][2]] - a;
        faces[t] = {(c[0] + c[1] + c[2]) / 3.0f, glm::length(glm::cross(u, v)) / 2,
                    std::max({difference(c[0], c[1]), difference(c[1], c[2]), difference(c[2], c[0])}) <= 2 * same};
    }
    return faces;
}

struct Patch {
    glm::vec3 first{0};
    glm::dvec3 sum{0};
    double area = 0;
    glm::vec3 mean() const { return area > 0 ? glm::vec3(sum / area) : first; }
};

/// The largest triangles say what colours there are.
std::vector<Patch> patches_of(const std::vector<Face>& faces, double& of_none) {
    std::vector<std::uint32_t> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return faces[a].area > faces[b].area; });
    std::vector<Patch> patches;
    of_none = 0;
    for (const std::uint32_t t : order) {
        const Face& face = faces[t];
        auto at = std::find_if(patches.begin(), patches.end(),
                               [&](const Patch& p) { return difference(p.first, face.colour) <= same; });
        if (!face.plain || (at == patches.end() && patches.size() == 2 * most_face_colours)) {
            of_none += face.area;
            continue;
        }
        if (at == patches.end()) at = patches.insert(at, {face.colour});
        at->sum += face.area * glm::dvec3(face.colour), at->area += face.area;
    }
    return patches;
}

/// Those that are more than triangles across borders.
std::vector<glm::vec3> plain_colours(std::vector<Patch> patches, double of_none, double area) {
    std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.area > b.area; });
    std::vector<glm::vec3> palette;
    for (const Patch& patch : patches) {
        const double left = on_borders * area - of_none;
        const bool small = patch.area < std::min(left, on_borders / 8 * area);
        if (small)
            of_none += patch.area;
        else
            palette.push_back(patch.mean());
    }
    if (palette.size() > most_face_colours || of_none > on_borders * area) return {};
    for (std::size_t a = 0; a < palette.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (difference(palette[a], palette[b]) < other) return {};
    return palette;
}

/// A vertex on a border has the colour of its largest side, for readers that know one colour a vertex.
void take_largest_colours(Level& level, const std::vector<Face>& faces, const CornerValues& colours) {
    std::vector<std::vector<std::pair<glm::vec3, double>>> sides(level.mesh.positions.size());
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (const std::uint32_t v : level.mesh.triangles[t]) {
            const auto same_colour = [&](const auto& side) { return side.first == colours[t][0]; };
            auto at = std::find_if(sides[v].begin(), sides[v].end(), same_colour);
            if (at == sides[v].end()) at = sides[v].insert(at, {colours[t][0], 0});
            at->second += faces[t].area;
        }
    for (std::size_t v = 0; v < sides.size(); ++v)
        if (!sides[v].empty())
            level.mesh.colours[v] = std::max_element(sides[v].begin(), sides[v].end(), [](const auto& a, const auto& b) {
                                        return a.second < b.second;
                                    })->first;
}

} // namespace

bool take_patch_colours(Level& level) {
    if (!has_colours(level.mesh, level.wedges) || level.mesh.triangles.empty()) return false;
    const std::vector<Face> faces = faces_of(level);
    double area = 0, of_none = 0;
    for (const Face& face : faces) area += face.area;
    const std::vector<Patch> patches = patches_of(faces, of_none);
    const std::vector<glm::vec3> palette = plain_colours(patches, of_none, area);
    if (palette.empty()) return false;
    CornerValues normals, colours;
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const auto nearest = std::min_element(palette.begin(), palette.end(), [&](const glm::vec3& a, const glm::vec3& b) {
            return glm::distance(a, faces[t].colour) < glm::distance(b, faces[t].colour);
        });
        colours.push_back({*nearest, *nearest, *nearest});
        if (has_normals(level.mesh, level.wedges)) normals.push_back(corner_normals(level.mesh, level.wedges, t));
    }
    std::vector<glm::vec3> own = level.mesh.normals; // of the largest wedges
    level.wedges = take_corner_values(level.mesh, normals, colours);
    if (own.size() == level.mesh.positions.size()) level.mesh.normals = std::move(own);
    if (!level.wedges.empty()) take_largest_colours(level, faces, colours);
    return true;
}

} // namespace glcast
