// Wavefront .obj, written: v with colours behind the position (as MeshLab and Blender write them), vt, vn, f; an .mtl
// where there is a texture.
#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"
#include "tools/mesh/corner_split.h"

namespace glcast::format {
namespace {

/// A normal map is no bump map: `norm`, which most readers know, and no map_Bump, which some take for heights.
bool write_mtl(FileSet& files, const std::filesystem::path& path, const Texture& texture) {
    PictureNames names;
    if (!write_pictures(files, path, texture, true, names)) return false;
    std::filesystem::path mtl = path;
    Gather out(files.companion(mtl.replace_extension(".mtl")));
    out << "# glcast " GLCAST_VERSION "\nnewmtl as_drawn\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\n";
    out << "map_Kd " << names.colour << "\nnorm " << names.normal << '\n';
    return out.flush();
}

/// `vn`: of the vertices or, where corners have their own, of the wedges.
void add_vertices(Gather& out, const Mesh& mesh, const std::vector<glm::vec3>& normals, bool with_colours) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        out << "v";
        for (int k = 0; k < 3; ++k) out << ' ' << mesh.positions[v][k];
        for (int k = 0; k < 3 && with_colours; ++k) out << ' ' << mesh.colours[v][k];
        out << '\n';
    }
    for (const glm::vec3& n : normals)
        out << "vn " << n.x << ' ' << n.y << ' ' << n.z << '\n';
}

} // namespace

/// Positions stay one a vertex: along a seam only texture coordinates differ, at a crease only normals.
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&) {
    const Mesh& mesh = level.mesh;
    const bool textured = !level.texture.empty(), own = !level.wedges.normals.empty();
    const std::vector<glm::vec3>& normals = own ? level.wedges.normals : mesh.normals;
    Gather out(files.mesh(path));
    out << "# glcast " GLCAST_VERSION "\n";
    if (level.set.count > 0) out << "# " << mark_name << ": " << mark_of(level.set) << '\n';
    if (textured) {
        if (!write_mtl(files, path, level.texture)) return false;
        out << "mtllib " << path.stem().string() << ".mtl\n";
    }
    if (level.set.count > 0) out << "o " << level.name << '\n';
    add_vertices(out, mesh, normals, !mesh.colours.empty() && !textured);
    const CornerSplit split = split_corners(mesh, level.texture, {});
    for (const glm::vec2& at : split.coordinates) out << "vt " << at.x << ' ' << 1 - at.y << '\n';
    if (textured) out << "usemtl as_drawn\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out << 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.triangles[t][k], normal = own ? level.wedges.corners[t][k] : v;
            out << ' ' << std::size_t(v) + 1;
            if (textured || !normals.empty()) out << '/';
            if (textured) out << std::size_t(split.triangles[t][k]) + 1;
            if (!normals.empty()) out << '/' << std::size_t(normal) + 1;
        }
        out << '\n';
    }
    return out.flush();
}

} // namespace glcast::format
