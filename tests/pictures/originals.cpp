#include "tests/pictures/originals.h"

#include <glm/geometric.hpp>
#include <stdexcept>

#include "fixtures/shapes.h"
#include "tools/io/mesh_io.h"

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

} // namespace

Mesh original(const std::string& name) {
    if (name == "t.obj") return t_obj();
    if (name == "teapot" || name == "spheres") return fixtures::truth(name);
    throw std::invalid_argument("no original " + name + ": teapot, spheres or t.obj");
}

} // namespace glcast::pictures
