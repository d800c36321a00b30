#include "tests/peers/simplify_peers.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <meshoptimizer.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <array>
#include <ctime>

namespace glcast::test {
namespace {

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Drops vertices that no triangle has.
Mesh used_part(const Mesh& mesh) {
    Mesh used;
    std::vector<std::uint32_t> number(mesh.positions.size(), UINT32_MAX);
    for (Triangle t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            if (number[v] == UINT32_MAX) {
                number[v] = std::uint32_t(used.positions.size());
                used.positions.push_back(mesh.positions[v]);
            }
            v = number[v];
        }
        used.triangles.push_back(t);
    }
    return used;
}

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

SimplifyPeerResult by_openmesh(const Mesh& mesh, std::size_t triangles) {
    using Surface = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
    Surface surface;
    surface.request_vertex_status();
    surface.request_edge_status();
    surface.request_halfedge_status();
    surface.request_face_status();
    for (const glm::dvec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles)
        surface.add_face(OpenMesh::VertexHandle(int(t[0])), OpenMesh::VertexHandle(int(t[1])),
                         OpenMesh::VertexHandle(int(t[2])));
    const double start = cpu_seconds();
    OpenMesh::Decimater::DecimaterT<Surface> decimater(surface);
    OpenMesh::Decimater::ModQuadricT<Surface>::Handle quadrics;
    decimater.add(quadrics);
    decimater.module(quadrics).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
    const double seconds = cpu_seconds() - start;
    surface.garbage_collection();
    Mesh left;
    for (const auto v : surface.vertices())
        left.positions.emplace_back(surface.point(v)[0], surface.point(v)[1], surface.point(v)[2]);
    for (const auto f : surface.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : surface.fv_range(f)) t[k++] = std::uint32_t(v.idx());
        left.triangles.push_back(t);
    }
    return {used_part(left), seconds};
}

using CgalSurface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// Where more than two triangles meet at an edge, vertices are doubled.
CgalSurface to_cgal(const Mesh& mesh) {
    namespace processing = CGAL::Polygon_mesh_processing;
    std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
    std::vector<std::array<std::size_t, 3>> soup;
    for (const glm::dvec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
    for (const Triangle& t : mesh.triangles) soup.push_back({t[0], t[1], t[2]});
    processing::orient_polygon_soup(points, soup);
    CgalSurface surface;
    processing::polygon_soup_to_polygon_mesh(points, soup, surface);
    return surface;
}

Mesh from_cgal(CgalSurface& surface) {
    surface.collect_garbage();
    Mesh mesh;
    for (const auto v : surface.vertices()) {
        const auto& p = surface.point(v);
        mesh.positions.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : surface.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
            t[k++] = std::uint32_t(v.idx());
        mesh.triangles.push_back(t);
    }
    return used_part(mesh);
}

namespace sms = CGAL::Surface_mesh_simplification;

struct FaceCount {
    std::size_t triangles;
    template <class Cost, class Profile>
    bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
        return profile.surface_mesh().number_of_faces() <= triangles;
    }
};

SimplifyPeerResult by_cgal_garland_heckbert(const Mesh& mesh, std::size_t triangles) {
    CgalSurface surface = to_cgal(mesh);
    using Policies = sms::GarlandHeckbert_plane_policies<CgalSurface, CGAL::Simple_cartesian<double>>;
    const double start = cpu_seconds();
    const Policies policies(surface);
    const sms::Bounded_normal_change_placement<Policies::Get_placement> placement(policies.get_placement());
    sms::edge_collapse(surface, FaceCount{triangles},
                       CGAL::parameters::get_cost(policies.get_cost()).get_placement(placement));
    const double seconds = cpu_seconds() - start;
    return {from_cgal(surface), seconds};
}

SimplifyPeerResult by_cgal_lindstrom_turk(const Mesh& mesh, std::size_t triangles) {
    CgalSurface surface = to_cgal(mesh);
    const double start = cpu_seconds();
    sms::edge_collapse(surface, FaceCount{triangles},
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<CgalSurface>())
                           .get_placement(sms::LindstromTurk_placement<CgalSurface>()));
    const double seconds = cpu_seconds() - start;
    return {from_cgal(surface), seconds};
}

SimplifyPeerResult by_meshoptimizer(const Mesh& mesh, std::size_t triangles) {
    std::vector<float> positions;
    std::vector<unsigned> indices;
    for (const glm::dvec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k) positions.push_back(float(p[k]));
    for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
    std::vector<unsigned> left(indices.size());
    const double start = cpu_seconds();
    left.resize(meshopt_simplify(left.data(), indices.data(), indices.size(), positions.data(),
                                 mesh.positions.size(), 3 * sizeof(float), 3 * triangles, 1e9F, 0, nullptr));
    const double seconds = cpu_seconds() - start;
    Mesh result;
    result.positions = mesh.positions;
    for (std::size_t i = 0; i < left.size(); i += 3)
        result.triangles.push_back({left[i], left[i + 1], left[i + 2]});
    return {used_part(result), seconds};
}

} // namespace

const std::vector<SimplifyPeer>& simplify_peers() {
    static const std::vector<SimplifyPeer> all = {
        {"OpenMesh DecimaterT, ModQuadricT", by_openmesh, "OpenMesh", true},
        {"CGAL, Garland and Heckbert", by_cgal_garland_heckbert, "CGAL"},
        {"CGAL, Lindstrom and Turk", by_cgal_lindstrom_turk, "CGAL", true},
        {"meshoptimizer", by_meshoptimizer, "meshoptimizer", true},
    };
    return all;
}

} // namespace glcast::test
