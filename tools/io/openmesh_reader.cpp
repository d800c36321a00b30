#include "tools/io/openmesh_reader.h"

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <istream>
#include <limits>
#include <streambuf>

#include "tools/io/mesh_format.h"
#include "tools/io/reader_process.h"

namespace glcast::format {
namespace {

using namespace OpenMesh;

glm::vec3 vec3(const Vec3f& v) { return {v[0], v[1], v[2]}; }

template <class List, class Value> void set(List& list, std::size_t at, std::size_t count, const Value& value) {
    if (at >= count) refuse("an attribute of a vertex or face that is not there");
    if (list.size() < count) list.resize(count, Value(0));
    list[at] = value;
}

/// Takes what a reader reads. OBJReader calls set_color for each corner of a face, then set_texcoord and set_normal where it has
/// them, then add_face with the corners that differ, if there are three: so corners are told by set_color, and repeated ones (a
/// bridge to a hole) stay, as do faces without area.
class SoupImporter final : public IO::BaseImporter {
  public:
    /// `sizes`: of the faces of an .obj; of other formats none.
    SoupImporter(bool corners_by_colour, std::span<const std::uint32_t> sizes)
        : corners_by_colour(corners_by_colour), sizes(sizes) {}
    Soup soup;

    VertexHandle add_vertex(const Vec3f& p) override { return add_vertex(Vec3d(p)); }
    VertexHandle add_vertex(const Vec3d& p) override {
        soup.positions.emplace_back(p[0], p[1], p[2]);
        return VertexHandle(static_cast<int>(soup.positions.size() - 1));
    }
    VertexHandle add_vertex() override { return add_vertex(Vec3d(0, 0, 0)); }
    void set_point(VertexHandle v, const Vec3f& p) override {
        set(soup.positions, index(v), soup.positions.size(), glm::dvec3(p[0], p[1], p[2]));
    }

    FaceHandle add_face(const VHandles& vertices) override {
        for (const VertexHandle v : vertices)
            if (index(v) >= soup.positions.size())
                refuse("a face has corner " + std::to_string(v.idx() + 1) + " of " + std::to_string(soup.positions.size()) +
                       " vertices");
        if (corners_by_colour)
            add_pending();
        else {
            soup.begin_face();
            for (const VertexHandle v : vertices) soup.corner(static_cast<std::uint32_t>(v.idx()));
        }
        return FaceHandle(static_cast<int>(soup.sizes.size() - 1));
    }

    void set_normal(VertexHandle v, const Vec3f& n) override {
        if (corners_by_colour) {
            if (!pending.empty()) pending.back().normal = vec3(n);
        } else
            set(soup.normals, index(v), soup.positions.size(), vec3(n));
    }
    void set_normal(VertexHandle v, const Vec3d& n) override { set_normal(v, Vec3f(n)); }
    void set_texcoord(VertexHandle, const Vec2f& at) override {
        if (corners_by_colour && !pending.empty()) pending.back().place = {at[0], at[1]};
    }

    void set_color(VertexHandle v, const Vec3uc& c) override { colour(v, vec3(Vec3f(c)) / 255.0f); }
    void set_color(VertexHandle v, const Vec4uc& c) override { set_color(v, Vec3uc(c[0], c[1], c[2])); }
    void set_color(VertexHandle v, const Vec4f& c) override { set_color(v, Vec3f(c[0], c[1], c[2])); }
    void set_color(VertexHandle v, const Vec3f& c) override {
        if (corners_by_colour)
            pending.push_back({static_cast<std::uint32_t>(index(v))});
        else
            colour(v, vec3(c));
    }
    void set_color(FaceHandle f, const Vec3uc& c) override { colour(f, vec3(Vec3f(c)) / 255.0f); }
    void set_color(FaceHandle f, const Vec4uc& c) override { set_color(f, Vec3uc(c[0], c[1], c[2])); }
    void set_color(FaceHandle f, const Vec3f& c) override { colour(f, vec3(c)); }
    void set_color(FaceHandle f, const Vec4f& c) override { set_color(f, Vec3f(c[0], c[1], c[2])); }

    /// Of an .obj: corners told so far become faces; those of the last are there only now.
    void add_pending() {
        std::size_t at = 0;
        while (soup.sizes.size() < sizes.size() && pending.size() - at >= sizes[soup.sizes.size()]) {
            const std::size_t end = at + sizes[soup.sizes.size()];
            soup.begin_face();
            for (; at < end; ++at) {
                soup.corner(pending[at].vertex);
                soup.corner_normals.push_back(pending[at].normal);
                soup.corner_places.push_back(pending[at].place);
            }
        }
        pending.erase(pending.begin(), pending.begin() + std::ptrdiff_t(at));
    }

    std::size_t n_vertices() const override { return soup.positions.size(); }
    std::size_t n_faces() const override { return soup.sizes.size(); }
    std::size_t n_edges() const override { return 0; }
    BaseKernel* kernel() override { return &custom; }

    // Nothing of ours.
    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>&) override {}
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_texcoord(VertexHandle, const Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
    void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
    void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void set_color(EdgeHandle, const Vec3uc&) override {}
    void set_color(EdgeHandle, const Vec4uc&) override {}
    void set_color(EdgeHandle, const Vec3f&) override {}
    void set_color(EdgeHandle, const Vec4f&) override {}
    void set_normal(FaceHandle, const Vec3f&) override {}
    void set_normal(FaceHandle, const Vec3d&) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}

  private:
    static constexpr float none = std::numeric_limits<float>::quiet_NaN();
    struct Corner {
        std::uint32_t vertex;
        glm::vec3 normal{none};
        glm::vec2 place{none};
    };

    static std::size_t index(const BaseHandle handle) { return static_cast<std::size_t>(handle.idx()); }
    void colour(VertexHandle v, const glm::vec3& c) { set(soup.colours, index(v), soup.positions.size(), c); }
    void colour(FaceHandle f, const glm::vec3& c) { set(soup.face_colours, index(f), soup.sizes.size(), c); }

    bool corners_by_colour;
    std::span<const std::uint32_t> sizes;
    std::vector<Corner> pending;
    BaseKernel custom; ///< where readers put properties that they do not know
};

IO::BaseReader& reader_of(OpenMeshKind kind) {
    switch (kind) {
    case OpenMeshKind::obj:
        return IO::OBJReader();
    case OpenMeshKind::ply:
        return IO::PLYReader();
    default:
        return IO::STLReader();
    }
}

/// Bytes in memory as a stream that can go back.
class Bytes : public std::streambuf {
  public:
    explicit Bytes(std::string_view bytes) {
        char* const first = const_cast<char*>(bytes.data()); // nothing writes through it
        setg(first, first, first + bytes.size());
    }

  protected:
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
        const off_type base = from == std::ios_base::beg   ? 0
                              : from == std::ios_base::cur ? gptr() - eback()
                                                           : egptr() - eback();
        const off_type at = base + offset;
        if (at < 0 || at > egptr() - eback()) return pos_type(off_type(-1));
        setg(eback(), eback() + at, egptr());
        return pos_type(at);
    }
    pos_type seekpos(pos_type at, std::ios_base::openmode which) override {
        return seekoff(off_type(at), std::ios_base::beg, which);
    }
};

Soup read(std::string_view text, OpenMeshKind kind, std::span<const std::uint32_t> sizes) {
    using IO::Options;
    Bytes bytes(text);
    std::istream stream(&bytes);
    SoupImporter importer(kind == OpenMeshKind::obj, sizes);
    Options wanted(Options::VertexNormal | Options::VertexColor | Options::FaceColor | Options::VertexTexCoord);
    if (kind == OpenMeshKind::stl_binary) wanted += Options::Binary;
    if (!reader_of(kind).read(stream, importer, wanted)) refuse("OpenMesh cannot read it");
    importer.add_pending();
    return std::move(importer.soup);
}

} // namespace

Soup read_with_openmesh(std::string_view text, OpenMeshKind kind, std::span<const std::uint32_t> sizes) {
    return soup_of(read_apart(text.size(), [&] { return bytes_of(read(text, kind, sizes)); }));
}

} // namespace glcast::format
