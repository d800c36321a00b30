// Wavefront .obj: v with colours behind the position (as MeshLab and Blender write them), vt, vn, f; written with an .mtl
// where there is a texture.
#include <algorithm>
#include <cmath>

#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"
#include "tools/mesh/corner_split.h"

namespace glcast::format {
namespace {

struct ObjReader {
    TextCursor cursor;
    Mesh mesh;
    std::vector<glm::vec3> vn;          ///< as in the file
    CornerValues corner_normals;        ///< by triangle, while every corner has one
    std::vector<std::uint32_t> of_face; ///< scratch: the vn of its corners
    std::vector<glm::vec3> normal_sums; ///< per vertex, of the vn its faces give it
    std::vector<std::uint32_t> corners; ///< scratch
    std::size_t coloured = 0, with_normal = 0;

    explicit ObjReader(std::string_view bytes) : cursor(bytes) {}

    void vertex(std::string_view line) {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) p[k] = cursor.number_on<double>(line, "a coordinate");
        double extra[3];
        int count = 0;
        for (std::string_view w = TextCursor::word(line); !w.empty() && count < 3;
             w = TextCursor::word(line), ++count)
            if (!TextCursor::parse(w, extra[count])) cursor.fail("a colour is no number");
        mesh.positions.push_back(p);
        mesh.colours.push_back(count == 3 ? glm::vec3(extra[0], extra[1], extra[2]) : glm::vec3(0));
        coloured += count == 3;
    }

    void normal(std::string_view line) {
        glm::vec3 n;
        for (int k = 0; k < 3; ++k) n[k] = cursor.number_on<float>(line, "a normal");
        vn.push_back(n);
    }

    /// 1-based, or negative: from the end of what has come so far.
    std::size_t index(std::string_view word, std::size_t count) const {
        long i = 0;
        if (!TextCursor::parse(word, i) || i == 0) cursor.fail("a face index is no number");
        const long at = i > 0 ? i - 1 : static_cast<long>(count) + i;
        // Positive ones may point to what comes later; read_levels checks them at the end.
        if (at < 0 || at > UINT32_MAX) cursor.fail("a face index is out of range");
        return static_cast<std::size_t>(at);
    }

    void face(std::string_view line) {
        corners.clear(), of_face.clear();
        for (std::string_view w = TextCursor::word(line); !w.empty(); w = TextCursor::word(line)) {
            const std::size_t slash = w.find('/'), second = slash == w.npos ? w.npos : w.find('/', slash + 1);
            const std::size_t v = index(w.substr(0, slash), mesh.positions.size());
            corners.push_back(static_cast<std::uint32_t>(v));
            if (second == w.npos || second + 1 == w.size()) continue;
            const std::size_t n = index(w.substr(second + 1), vn.size());
            if (n >= vn.size() || v >= mesh.positions.size()) continue;
            if (normal_sums.size() < mesh.positions.size())
                normal_sums.resize(mesh.positions.size(), glm::vec3(0));
            normal_sums[v] += vn[n];
            ++with_normal;
            of_face.push_back(static_cast<std::uint32_t>(n));
        }
        if (corners.size() < 3) cursor.fail("a face has fewer than three corners");
        const bool whole = corner_normals.size() == mesh.triangles.size() && of_face.size() == corners.size();
        add_fan(mesh, corners);
        for (std::size_t k = 2; k < of_face.size() && whole; ++k)
            corner_normals.push_back({vn[of_face[0]], vn[of_face[k - 1]], vn[of_face[k]]});
    }

    void read() {
        std::string_view line;
        while (cursor.next_line(line)) {
            const std::string_view what = TextCursor::word(line);
            if (what == "v") vertex(line);
            if (what == "vn") normal(line);
            if (what == "f") face(line);
        }
        if (coloured < mesh.positions.size()) mesh.colours.clear();
        if (with_normal > 0 && normal_sums.size() == mesh.positions.size())
            mesh.normals = std::move(normal_sums);
    }

    /// Of the mesh once it is whole and all its corners are vertices that there are.
    Wedges wedges(Mesh& whole) const {
        const auto there = [&](const Triangle& t) {
            return std::max({t[0], t[1], t[2]}) < whole.positions.size();
        };
        if (corner_normals.empty() || corner_normals.size() != whole.triangles.size() ||
            !std::ranges::all_of(whole.triangles, there))
            return {};
        return take_corner_values(whole, corner_normals, {});
    }
};

} // namespace

std::vector<Level> read_obj(std::string_view bytes) {
    ObjReader reader(bytes);
    reader.read();
    if (reader.mesh.positions.empty()) refuse("holds no vertices");
    std::vector<Level> levels = one_level(std::move(reader.mesh));
    levels[0].wedges = reader.wedges(levels[0].mesh);
    return levels;
}

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
        for (int k = 0; k < 3 && with_colours; ++k) out << ' ' << double(mesh.colours[v][k]);
        out << '\n';
    }
    for (const glm::vec3& n : normals)
        out << "vn " << double(n.x) << ' ' << double(n.y) << ' ' << double(n.z) << '\n';
}

} // namespace

/// Positions stay one a vertex: along a seam only texture coordinates differ, at a crease only normals.
bool write_obj(FileSet& files, const std::filesystem::path& path, const Level& level) {
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
    for (const glm::vec2& at : split.coordinates) out << "vt " << double(at.x) << ' ' << 1 - double(at.y) << '\n';
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
