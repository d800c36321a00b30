// Wavefront .obj, written: v with colours behind the position (as MeshLab and Blender write them), vt, vn, f; an .mtl
// where there are a texture or plain colours of faces.
#include <algorithm>
#include <bit>
#include <cmath>

#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"
#include "tools/mesh/corner_split.h"
#include "tools/mesh/face_colours.h"

namespace glcast::format {
namespace {

constexpr int swatch = 8; ///< texels along an edge: filters and mipmaps of the middle see one colour

/// Squares side by side, one of each plain colour.
std::size_t swatches(const FaceColours& colours) { return std::bit_ceil(colours.palette.size()); }

Texture palette_of(const FaceColours& colours) {
    Texture palette;
    Picture& picture = palette.colour;
    picture.width = swatch * int(swatches(colours)), picture.height = swatch;
    for (int y = 0; y < swatch; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const std::size_t which = std::min(std::size_t(x / swatch), colours.palette.size() - 1);
            for (int c = 0; c < 3; ++c)
                picture.rgb.push_back(std::uint8_t(std::lround(std::clamp(colours.palette[which][c], 0.0f, 1.0f) * 255)));
        }
    return palette;
}

/// A normal map is no bump map: `norm`, which most readers know, and no map_Bump, which some take for heights.
bool write_mtl(FileSet& files, const std::filesystem::path& path, const Texture& texture, bool with_normal) {
    PictureNames names;
    if (!write_pictures(files, path, texture, with_normal, names)) return false;
    std::filesystem::path mtl = path;
    Gather out(files.companion(mtl.replace_extension(".mtl")));
    out << "# glcast " GLCAST_VERSION "\nnewmtl as_drawn\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\n";
    out << "map_Kd " << names.colour << '\n';
    if (with_normal) out << "norm " << names.normal << '\n';
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

/// Positions stay one a vertex: along a seam only texture coordinates differ, at a crease only normals. Plain colours of
/// faces are a picture, too, with a place for each, and no `Kd`: Blender takes that for linear light, others for display values.
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&) {
    const Mesh& mesh = level.mesh;
    const FaceColours colours = face_colours(level);
    const bool textured = !level.texture.empty(), plain = !colours.empty(), own = !level.wedges.normals.empty();
    const std::vector<glm::vec3>& normals = own ? level.wedges.normals : mesh.normals;
    Gather out(files.mesh(path));
    out << "# glcast " GLCAST_VERSION "\n";
    if (level.set.count > 0) out << "# " << mark_name << ": " << mark_of(level.set) << '\n';
    if (textured || plain) {
        if (!write_mtl(files, path, plain ? palette_of(colours) : level.texture, textured)) return false;
        out << "mtllib " << path.stem().string() << ".mtl\n";
    }
    if (level.set.count > 0) out << "o " << level.name << '\n';
    add_vertices(out, mesh, normals, !mesh.colours.empty() && !textured && !plain);
    const CornerSplit split = split_corners(mesh, level.texture, {});
    for (const glm::vec2& at : split.coordinates) out << "vt " << at.x << ' ' << 1 - at.y << '\n';
    for (std::size_t k = 0; k < colours.palette.size(); ++k)
        out << "vt " << (float(k) + 0.5f) / float(swatches(colours)) << " 0.5\n";
    if (textured || plain) out << "usemtl as_drawn\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out << 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.triangles[t][k], normal = own ? level.wedges.corners[t][k] : v;
            out << ' ' << std::size_t(v) + 1;
            if (textured || plain || !normals.empty()) out << '/';
            if (textured || plain) out << std::size_t(plain ? colours.face[t] : split.triangles[t][k]) + 1;
            if (!normals.empty()) out << '/' << std::size_t(normal) + 1;
        }
        out << '\n';
    }
    return out.flush();
}

} // namespace glcast::format
