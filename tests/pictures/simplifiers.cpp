// Other people's simplifiers, with the settings of their own manuals.
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <meshoptimizer.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <cfloat>

#include "tests/pictures/originals.h"

namespace glcast::pictures {
namespace {

/// Only the vertices that triangles use.
Mesh packed(const Mesh& mesh) {
    Mesh out;
    std::vector<std::uint32_t> number(mesh.positions.size(), UINT32_MAX);
    for (Triangle t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = std::uint32_t(out.positions.size());
                out.positions.push_back(mesh.positions[v]);
            }
            v = number[v];
        }
        out.triangles.push_back(t);
    }
    return out;
}

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

Mesh by_openmesh(const Mesh& mesh, std::size_t triangles) {
    using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
    HalfEdges half_edges;
    std::vector<HalfEdges::VertexHandle> handles;
    for (const glm::dvec3& p : mesh.positions) handles.push_back(half_edges.add_vertex({p.x, p.y, p.z}));
    for (const Triangle& t : mesh.triangles) half_edges.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
    OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(half_edges);
    OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
    half_edges.garbage_collection();
    Mesh out;
    for (const auto v : half_edges.vertices()) {
        const auto p = half_edges.point(v);
        out.positions.emplace_back(p[0], p[1], p[2]);
    }
    for (const auto f : half_edges.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : half_edges.fv_range(f)) t[k++] = std::uint32_t(v.idx());
        out.triangles.push_back(t);
    }
    return packed(out);
}

Mesh by_meshoptimizer(const Mesh& mesh, std::size_t triangles) {
    std::vector<float> places;
    for (const glm::dvec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k) places.push_back(float(p[k]));
    std::vector<unsigned> corners, left(mesh.triangles.size() * 3);
    for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), places.data(),
                                 mesh.positions.size(), 3 * sizeof(float), triangles * 3, FLT_MAX));
    Mesh out = mesh;
    out.triangles.clear();
    for (std::size_t i = 0; i < left.size(); i += 3)
        out.triangles.push_back({left[i], left[i + 1], left[i + 2]});
    return packed(out);
}

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct FaceCount {
    std::size_t triangles;
    template <class Cost, class Profile>
    bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
        return profile.surface_mesh().number_of_faces() <= triangles;
    }
};

Mesh by_cgal(const Mesh& mesh, std::size_t triangles) {
    namespace Processing = CGAL::Polygon_mesh_processing;
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> soup;
    for (const glm::dvec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
    for (const Triangle& t : mesh.triangles) soup.push_back({t[0], t[1], t[2]});
    Processing::orient_polygon_soup(points, soup);
    SurfaceMesh surface;
    Processing::polygon_soup_to_polygon_mesh(points, soup, surface);
    CGAL::Surface_mesh_simplification::edge_collapse(surface, FaceCount{triangles});
    surface.collect_garbage();
    Mesh out;
    for (const auto v : surface.vertices()) {
        const auto& p = surface.point(v);
        out.positions.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : surface.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
            t[k++] = std::uint32_t(std::size_t(v));
        out.triangles.push_back(t);
    }
    return out;
}

} // namespace

const std::vector<Simplifier>& simplifiers() {
    static const std::vector<Simplifier> all = {
        {"OpenMesh", by_openmesh}, {"meshoptimizer", by_meshoptimizer}, {"CGAL", by_cgal}};
    return all;
}

} // namespace glcast::pictures
