#include "tests/progressive/openmesh_reader.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModProgMeshT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>
#include <bit>
#include <sstream>
#include <stdexcept>

namespace glcast::test {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using OmMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

[[noreturn]] void refuse(const char* why) { throw std::runtime_error(why); }

class Words {
  public:
    explicit Words(std::string_view bytes) : rest(bytes) {}
    std::uint32_t word() {
        if (rest.size() < 4) refuse("the file is too short");
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t(std::uint8_t(rest[k])) << 8 * k;
        rest.remove_prefix(4);
        return value;
    }
    OpenMesh::Vec3f point() {
        OpenMesh::Vec3f p;
        for (int k = 0; k < 3; ++k) p[k] = std::bit_cast<float>(word());
        return p;
    }
    bool empty() const { return rest.empty(); }

  private:
    std::string_view rest;
};

OmMesh::VertexHandle vertex(const OmMesh& mesh, std::uint32_t index, bool may_be_none) {
    if (index == UINT32_MAX && may_be_none) return OmMesh::VertexHandle();
    if (index >= mesh.n_vertices()) refuse("an index is no vertex");
    return OmMesh::VertexHandle(int(index));
}

void split(OmMesh& mesh, Words& words) {
    const OpenMesh::Vec3f point = words.point();
    const auto v1 = vertex(mesh, words.word(), false), vl = vertex(mesh, words.word(), true),
               vr = vertex(mesh, words.word(), true);
    if (!vl.is_valid() && !vr.is_valid()) refuse("a split has no side");
    for (const auto side : {vl, vr})
        if (side.is_valid() && !mesh.find_halfedge(v1, side).is_valid())
            refuse("a split has a side that is no neighbour");
    mesh.vertex_split(point, v1, vl, vr);
}

} // namespace

OpenMeshRefined refined_by_openmesh(std::string_view file, std::size_t splits) {
    if (!file.starts_with("ProgMesh")) refuse("no .pm");
    Words words(file.substr(8));
    OpenMeshRefined out;
    out.base_vertices = words.word(), out.base_triangles = words.word(), out.splits = words.word();
    OmMesh mesh;
    for (std::size_t k = 0; k < out.base_vertices; ++k) mesh.add_vertex(words.point());
    for (std::size_t k = 0; k < out.base_triangles; ++k) {
        const auto a = vertex(mesh, words.word(), false), b = vertex(mesh, words.word(), false),
                   c = vertex(mesh, words.word(), false);
        if (!mesh.add_face(a, b, c).is_valid()) refuse("a base triangle does not fit the others");
    }
    for (std::size_t k = 0; k < std::min(out.splits, splits); ++k) split(mesh, words);
    if (splits >= out.splits && !words.empty()) refuse("the file is longer than it says");
    for (const auto v : mesh.vertices())
        out.positions.emplace_back(mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]);
    for (const auto f : mesh.faces()) {
        Triangle corners{};
        std::size_t k = 0;
        for (const auto v : mesh.fv_range(f)) corners[k++] = std::uint32_t(v.idx());
        out.triangles.push_back(corners);
    }
    std::ostringstream trouble;
    out.manifold = OpenMesh::Utils::MeshCheckerT<OmMesh>(mesh).check(
        OpenMesh::Utils::MeshCheckerT<OmMesh>::CHECK_ALL, trouble);
    return out;
}

void write_by_openmesh(const Mesh& from, std::size_t vertices, const std::string& path) {
    OmMesh mesh;
    for (const glm::dvec3& p : from.positions) mesh.add_vertex({float(p.x), float(p.y), float(p.z)});
    for (const Triangle& t : from.triangles)
        mesh.add_face(OmMesh::VertexHandle(int(t[0])), OmMesh::VertexHandle(int(t[1])),
                      OmMesh::VertexHandle(int(t[2])));
    OpenMesh::Decimater::DecimaterT<OmMesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<OmMesh>::Handle quadric;
    OpenMesh::Decimater::ModProgMeshT<OmMesh>::Handle progressive;
    decimater.add(quadric), decimater.add(progressive);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to(vertices);
    if (!decimater.module(progressive).write(path)) refuse("OpenMesh cannot write its .pm");
}

} // namespace glcast::test
