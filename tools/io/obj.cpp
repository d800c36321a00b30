// Wavefront .obj, written: v with colours behind the position (as MeshLab and Blender write them), vt, vn, f; an .mtl
// where there are a texture or plain colours of faces.
#include <algorithm>
#include <cstdio>
#include <numeric>

#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"
#include "tools/mesh/corner_split.h"
#include "tools/mesh/face_colours.h"

namespace glcast::format {
namespace {

constexpr const char* textured_material = "as_drawn";

/// No two alike, though two colours may be one in bytes.
std::vector<std::string> material_names(const FaceColours& colours) {
    std::vector<std::string> names;
    for (const glm::vec3& colour : colours.palette) {
        std::string name = material_name(colour);
        while (std::find(names.begin(), names.end(), name) != names.end()) name += '_';
        names.push_back(name);
    }
    return names;
}

/// A normal map is no bump map: `norm`, which most readers know, and no map_Bump, which some take for heights.
bool write_mtl(FileSet& files, const std::filesystem::path& path, const Texture& texture, const FaceColours& colours) {
    PictureNames names;
    if (!texture.empty() && !write_pictures(files, path, texture, true, names)) return false;
    std::filesystem::path mtl = path;
    Gather out(files.companion(mtl.replace_extension(".mtl")));
    out << "# glcast " GLCAST_VERSION "\n";
    const auto material = [&](const std::string& name, const glm::vec3& kd) {
        char diffuse[64]; // VTK 9.1 (f3d) takes no exponents here
        std::snprintf(diffuse, sizeof diffuse, "%.6f %.6f %.6f", double(kd.x), double(kd.y), double(kd.z));
        out << "newmtl " << name << "\nKa 0 0 0\nKd " << diffuse << "\nKs 0 0 0\nillum 1\n";
    };
    if (!texture.empty()) {
        material(textured_material, glm::vec3(1));
        out << "map_Kd " << names.colour << "\nnorm " << names.normal << '\n';
    }
    const std::vector<std::string> of_colours = material_names(colours);
    for (std::size_t k = 0; k < of_colours.size(); ++k) material(of_colours[k], colours.palette[k]);
    return out.flush();
}

/// The faces in their order or, where each has a plain colour, by material.
std::vector<std::uint32_t> order_of_faces(const Mesh& mesh, const FaceColours& colours) {
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    if (!colours.empty())
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return colours.face[a] < colours.face[b]; });
    return order;
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
/// faces are materials, and then there are none behind `v`: readers would multiply the two.
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level, const WriteOptions&) {
    const Mesh& mesh = level.mesh;
    const bool textured = !level.texture.empty(), own = !level.wedges.normals.empty();
    const FaceColours colours = face_colours(level);
    const std::vector<glm::vec3>& normals = own ? level.wedges.normals : mesh.normals;
    Gather out(files.mesh(path));
    out << "# glcast " GLCAST_VERSION "\n";
    if (level.set.count > 0) out << "# " << mark_name << ": " << mark_of(level.set) << '\n';
    if (textured || !colours.empty()) {
        if (!write_mtl(files, path, level.texture, colours)) return false;
        out << "mtllib " << path.stem().string() << ".mtl\n";
    }
    if (level.set.count > 0) out << "o " << level.name << '\n';
    add_vertices(out, mesh, normals, !mesh.colours.empty() && !textured && colours.empty());
    const CornerSplit split = split_corners(mesh, level.texture, {});
    for (const glm::vec2& at : split.coordinates) out << "vt " << at.x << ' ' << 1 - at.y << '\n';
    if (textured) out << "usemtl " << textured_material << '\n';
    const std::vector<std::string> names = material_names(colours);
    std::uint32_t material = UINT32_MAX;
    for (const std::uint32_t t : order_of_faces(mesh, colours)) {
        if (!colours.empty() && colours.face[t] != material)
            out << "usemtl " << names[material = colours.face[t]] << '\n';
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
