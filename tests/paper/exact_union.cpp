// Solid modelling by CGAL's corefinement (Loriot et al., "Polygon Mesh Processing"), for Table 2.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

#include "tests/paper/originals.h"

namespace glcast::paper {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Solid = CGAL::Surface_mesh<Kernel::Point_3>;

Solid solid(const Mesh& mesh) {
    Solid result;
    for (const glm::dvec3& p : mesh.positions) result.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles)
        result.add_face(Solid::Vertex_index(t[0]), Solid::Vertex_index(t[1]), Solid::Vertex_index(t[2]));
    return result;
}

Mesh mesh_of(Solid& solid) {
    solid.collect_garbage();
    Mesh mesh;
    for (const auto v : solid.vertices()) {
        const auto& p = solid.point(v);
        mesh.positions.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    }
    for (const auto f : solid.faces()) {
        Triangle triangle{};
        std::size_t corner = 0;
        for (const auto v : CGAL::vertices_around_face(solid.halfedge(f), solid))
            triangle[corner++] = std::uint32_t(v.idx());
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

/// One mesh a ball; the fixture's truth holds them one after another, each in its own colour.
std::vector<Mesh> balls(const Mesh& all) {
    std::vector<Mesh> parts;
    for (const Triangle& t : all.triangles) {
        if (parts.empty() || all.colours[t[0]] != parts.back().colours[0]) {
            parts.emplace_back();
            parts.back().positions = all.positions;
            parts.back().colours = {all.colours[t[0]]};
        }
        parts.back().triangles.push_back(t);
    }
    for (Mesh& part : parts) {
        Mesh alone;
        std::vector<std::uint32_t> number(part.positions.size(), UINT32_MAX);
        for (Triangle t : part.triangles) {
            for (std::uint32_t& v : t) {
                if (number[v] == UINT32_MAX) {
                    number[v] = std::uint32_t(alone.positions.size());
                    alone.positions.push_back(part.positions[v]);
                }
                v = number[v];
            }
            alone.triangles.push_back(t);
        }
        part = welded(alone);
    }
    return parts;
}

} // namespace

Mesh spheres_union(int fineness) {
    const std::vector<Mesh> parts = balls(spheres(fineness));
    Solid whole = solid(parts.at(0));
    for (std::size_t k = 1; k < parts.size(); ++k) {
        Solid ball = solid(parts[k]);
        if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(whole, ball, whole))
            throw std::runtime_error("CGAL could not unite the spheres");
    }
    return mesh_of(whole);
}

} // namespace glcast::paper
