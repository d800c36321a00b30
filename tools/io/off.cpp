// Object File Format as in Geomview, written: OFF or COFF.
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
bool write_off(FileSet& files, const std::filesystem::path& path, const Level& level) {
    const Mesh& mesh = level.mesh;
    Gather out(files.mesh(path));
    const bool colours = !mesh.colours.empty();
    out << (colours ? "COFF\n" : "OFF\n"); // no comment line: OpenMesh takes one for the counts
    out << mesh.positions.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3& p = mesh.positions[v];
        out << p.x << ' ' << p.y << ' ' << p.z;
        for (int k = 0; k < 3 && colours; ++k) out << ' ' << mesh.colours[v][k];
        out << (colours ? " 1\n" : "\n");
    }
    for (const Triangle& t : mesh.triangles)
        out << "3 " << std::size_t(t[0]) << ' ' << std::size_t(t[1]) << ' ' << std::size_t(t[2]) << '\n';
    return out.flush();
}

} // namespace glcast::format
