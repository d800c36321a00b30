// Wavefront .obj, written: v with colours behind the position (as MeshLab and Blender write them), vt, vn, f; an .mtl
// where there is a texture.

#include "tools/io/mesh_format.h"
#include "tools/io/seams.h"
#include "tools/io/text_cursor.h"

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

void add_vertices(Gather& out, const Mesh& mesh, bool with_colours) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        out << "v";
        for (int k = 0; k < 3; ++k) out << ' ' << mesh.positions[v][k];
        for (int k = 0; k < 3 && with_colours; ++k) out << ' ' << mesh.colours[v][k];
        out << '\n';
    }
    for (const glm::vec3& n : mesh.normals)
        out << "vn " << n.x << ' ' << n.y << ' ' << n.z << '\n';
}

} // namespace

/// Positions stay one a vertex: along a seam only texture coordinates differ.
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level) {
    const Mesh& mesh = level.mesh;
    const bool textured = !level.texture.empty();
    Gather out(files.mesh(path));
    out << "# glcast " GLCAST_VERSION "\n";
    if (textured) {
        if (!write_mtl(files, path, level.texture)) return false;
        out << "mtllib " << path.stem().string() << ".mtl\n";
    }
    add_vertices(out, mesh, !mesh.colours.empty() && !textured);
    const SeamSplit split = split_along_seams(level);
    for (const glm::vec2& at : split.coordinates) out << "vt " << at.x << ' ' << 1 - at.y << '\n';
    if (textured) out << "usemtl as_drawn\n";
    for (const Triangle& t : split.triangles) {
        out << 'f';
        for (const std::uint32_t corner : t) {
            const std::size_t v = split.original(mesh, corner) + 1;
            out << ' ' << v;
            if (textured || !mesh.normals.empty()) out << '/';
            if (textured) out << std::size_t(corner) + 1;
            if (!mesh.normals.empty()) out << '/' << v;
        }
        out << '\n';
    }
    return out.flush();
}

} // namespace glcast::format
