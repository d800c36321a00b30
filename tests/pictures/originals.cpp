#include "tests/pictures/originals.h"

#include <glm/geometric.hpp>
#include <stdexcept>

#include "fixtures/shapes.h"
#include "tests/paper/originals.h"
#include "tools/deviation/surface_index.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/point_triangle.h"

namespace glcast::pictures {
namespace {

/// As OpenSceneGraph smooths what has none.
void add_smooth_normals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t[0]];
        const glm::dvec3 normal = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        for (const std::uint32_t v : t) sums[v] += normal;
    }
    for (const glm::dvec3& sum : sums) mesh.normals.emplace_back(glm::normalize(sum));
}

/// OpenSceneGraph's reader of .obj turns y up into z up.
Mesh t_obj() {
    Mesh mesh = read_mesh(TEST_DATA "/t.obj");
    for (glm::dvec3& p : mesh.positions) p = {p.x, -p.z, p.y};
    mesh.normals.clear();
    add_smooth_normals(mesh);
    return mesh;
}

template <class T> T mixed(const std::vector<T>& of, const Triangle& t, const glm::dvec3& weights) {
    return of[t[0]] * float(weights.x) + of[t[1]] * float(weights.y) + of[t[2]] * float(weights.z);
}

void take_attributes(Mesh& mesh, const Mesh& from) {
    const SurfaceIndex index(from);
    mesh.normals.clear(), mesh.colours.clear();
    for (const glm::dvec3& p : mesh.positions) {
        const Triangle& t = from.triangles[index.nearest(p).triangle];
        const TrianglePoint at =
            nearest_in_triangle(p, from.positions[t[0]], from.positions[t[1]], from.positions[t[2]]);
        const glm::vec3 normal = mixed(from.normals, t, at.weights);
        mesh.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : normal);
        if (!from.colours.empty()) mesh.colours.push_back(mixed(from.colours, t, at.weights));
    }
}

} // namespace

Mesh original(const std::string& name) {
    if (name == "t.obj") return t_obj();
    if (name == "teapot" || name == "spheres") return fixtures::truth(name);
    throw std::invalid_argument("no original " + name + ": teapot, spheres or t.obj");
}

Mesh simplified_original(const Mesh& original, const test::SimplifyPeer& peer, std::size_t triangles) {
    if (original.triangles.size() <= triangles) return original;
    Mesh mesh = peer.run(paper::welded(original), triangles).mesh;
    take_attributes(mesh, original);
    return mesh;
}

} // namespace glcast::pictures
