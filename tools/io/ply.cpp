// .ply, written: binary, little endian; doubles where floats would lose digits.
#include <cmath>

#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/ply_header.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {

namespace {

using ply::wedge_colours, ply::wedge_normals;

std::array<glm::vec3, 3> in_bytes(std::array<glm::vec3, 3> colours) {
    for (glm::vec3& c : colours)
        for (int k = 0; k < 3; ++k) c[k] = float(std::lround(c[k] * 255)) / 255;
    return colours;
}

} // namespace

/// Texture coordinates, and normals and colours of wedges, belong to corners, as MeshLab writes them: the mesh stays
/// as it is.
bool write_ply(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&) {
    const Mesh& mesh = level.mesh;
    const bool textured = !level.texture.empty();
    PictureNames names;
    Gather out(files.mesh(path));
    if (textured && !write_pictures(files, path, level.texture, false, names)) return false;
    const Wedges& wedges = level.wedges;
    const bool wide = !floats_hold(mesh), normals = !mesh.normals.empty(), colours = !mesh.colours.empty();
    out << "ply\nformat binary_little_endian 1.0\ncomment glcast " GLCAST_VERSION "\n";
    if (level.set.count > 0) out << "comment " << mark_name << ": " << mark_of(level.set) << '\n';
    if (textured) out << "comment TextureFile " << names.colour << '\n';
    out << "element vertex " << mesh.positions.size() << '\n';
    for (const char* name : {"x", "y", "z"})
        out << (wide ? "property double " : "property float ") << name << '\n';
    if (normals) out << "property float nx\nproperty float ny\nproperty float nz\n";
    if (colours) out << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out << "element face " << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\n";
    if (textured) out << "property list uchar float texcoord\n";
    if (!wedges.normals.empty()) out << "property list uchar float " << wedge_normals << '\n';
    if (!wedges.colours.empty()) out << "property list uchar float " << wedge_colours << '\n';
    out << "end_header\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (wide)
            out.bytes(mesh.positions[v]);
        else
            out.bytes(glm::vec3(mesh.positions[v]));
        if (normals) out.bytes(mesh.normals[v]);
        for (int k = 0; k < 3 && colours; ++k)
            out << static_cast<char>(std::lround(mesh.colours[v][k] * 255.0f));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out << '\3', out.bytes(mesh.triangles[t]);
        if (textured) {
            out << '\6';
            for (const glm::vec2& at : level.texture.coordinates[t]) out.bytes(glm::vec2(at.x, 1 - at.y));
        }
        if (!wedges.normals.empty()) out << '\11', out.bytes(corner_normals(mesh, wedges, t));
        if (!wedges.colours.empty()) out << '\11', out.bytes(in_bytes(corner_colours(mesh, wedges, t)));
    }
    return out.flush();
}

} // namespace glcast::format
