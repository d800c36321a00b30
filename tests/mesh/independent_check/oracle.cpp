#include "tests/mesh/independent_check/oracle.h"

// Before the mesh: it brings the readers.
#include <OpenMesh/Core/IO/MeshIO.hh>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace glcast::test {
namespace {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// OpenMesh says so itself on stderr each time that it refuses a face; the opinion tells it once.
struct Quiet {
    Quiet() { omerr().disable(); }
    ~Quiet() { omerr().enable(); }
};

OracleOpinion opinion_of(const HalfEdgeMesh& mesh) {
    OracleOpinion opinion{mesh.n_vertices(), mesh.n_edges(), mesh.n_faces(), {}};
    std::size_t boundary = 0, isolated = 0, pinched = 0;
    for (const auto edge : mesh.edges()) boundary += mesh.is_boundary(edge);
    for (const auto vertex : mesh.vertices()) {
        isolated += mesh.is_isolated(vertex);
        pinched += !mesh.is_manifold(vertex);
    }
    if (opinion.triangles == 0)
        opinion.fault = "no triangles";
    else if (boundary)
        opinion.fault = std::to_string(boundary) + " boundary edges";
    else if (pinched)
        opinion.fault = std::to_string(pinched) + " non-manifold vertices";
    else if (isolated)
        opinion.fault = std::to_string(isolated) + " vertices without a triangle";
    return opinion;
}

} // namespace

OracleOpinion ask_oracle(const Mesh& mesh) {
    const Quiet quiet;
    HalfEdgeMesh half_edges;
    std::vector<HalfEdgeMesh::VertexHandle> handles;
    for (const glm::dvec3& p : mesh.positions)
        handles.push_back(half_edges.add_vertex(HalfEdgeMesh::Point(float(p.x), float(p.y), float(p.z))));
    std::size_t refused = 0;
    for (const Triangle& t : mesh.triangles)
        refused += !half_edges.add_face(handles.at(t[0]), handles.at(t[1]), handles.at(t[2])).is_valid();
    OracleOpinion opinion = opinion_of(half_edges);
    if (refused) opinion.fault = std::to_string(refused) + " triangles refused as not manifold";
    return opinion;
}

OracleOpinion ask_oracle(const std::filesystem::path& file) {
    const Quiet quiet;
    HalfEdgeMesh
        mesh; // faces that do not fit are added by the readers with corners of their own: boundary edges
    OracleOpinion opinion;
    if (!OpenMesh::IO::read_mesh(mesh, file.string())) opinion.fault = "OpenMesh cannot read it";
    return opinion.fault.empty() ? opinion_of(mesh) : opinion;
}

} // namespace glcast::test
