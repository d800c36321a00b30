#include "tests/mesh/independent_check/cgal.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace glcast::test {

std::vector<TrianglePair> cgal_self_intersections(const Mesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    Surface surface;
    for (const glm::dvec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
    using Vertex = Surface::Vertex_index;
    for (const Triangle& t : mesh.triangles)
        if (surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Surface::null_face())
            throw std::logic_error("CGAL takes manifold meshes only");
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    std::vector<TrianglePair> pairs;
    for (const auto& [a, b] : found)
        pairs.emplace_back(std::min(a.idx(), b.idx()), std::max(a.idx(), b.idx()));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace glcast::test
