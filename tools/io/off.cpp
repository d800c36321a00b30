// Object File Format as in Geomview: OFF, COFF, NOFF, CNOFF, STOFF; colours as 0..1 or 0..255.
#include <algorithm>

#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

struct OffReader {
    TextCursor cursor;
    std::size_t size;
    Mesh mesh;
    bool normals = false, colours = false;
    float brightest = 0;

    explicit OffReader(std::string_view bytes) : cursor(bytes), size(bytes.size()) {}

    std::string_view full_line() {
        std::string_view line;
        if (!cursor.next_full_line(line)) refuse("the file is truncated");
        return line;
    }

    /// What follows the keyword on its line: nothing, or the counts.
    std::string_view keyword(std::string_view line) {
        std::string_view rest = line;
        std::string_view word = TextCursor::word(rest);
        if (!word.ends_with("OFF")) refuse("is no OFF file");
        word.remove_suffix(3);
        if (word.starts_with("ST")) word.remove_prefix(2); // texture coordinates come last, and are not read
        if (word.starts_with("C")) colours = true, word.remove_prefix(1);
        if (word.starts_with("N")) normals = true, word.remove_prefix(1);
        if (!word.empty()) refuse("is of a kind of OFF that is not read: four or n dimensions");
        rest = TextCursor::trimmed(rest);
        if (rest.starts_with("BINARY")) refuse("is a binary OFF file, which is not read");
        return rest;
    }

    void vertex(std::string_view line) {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) p[k] = cursor.number_on<double>(line, "a coordinate");
        mesh.positions.push_back(p);
        if (normals) {
            glm::vec3 n;
            for (int k = 0; k < 3; ++k) n[k] = cursor.number_on<float>(line, "a normal");
            mesh.normals.push_back(n);
        }
        if (colours) {
            glm::vec3 c;
            for (int k = 0; k < 3; ++k)
                brightest = std::max(brightest, c[k] = cursor.number_on<float>(line, "a colour"));
            mesh.colours.push_back(c);
        }
    }

    void face(std::string_view line, std::vector<std::uint32_t>& corners) {
        const auto count = cursor.number_on<std::uint32_t>(line, "the number of corners");
        corners.clear();
        for (std::uint32_t k = 0; k < count; ++k)
            corners.push_back(cursor.number_on<std::uint32_t>(line, "a corner"));
        add_fan(mesh, corners); // fewer than three: no triangle; colours of faces are not kept
    }

    void read() {
        std::string_view counts = keyword(full_line());
        if (counts.empty()) counts = full_line();
        const auto vertices = cursor.number_on<std::size_t>(counts, "the number of vertices");
        const auto faces = cursor.number_on<std::size_t>(counts, "the number of faces");
        if (vertices > size / 2 || faces > size / 2) refuse("the file is truncated, or its counts are wrong");
        for (std::size_t v = 0; v < vertices; ++v) vertex(full_line());
        std::vector<std::uint32_t> corners;
        for (std::size_t f = 0; f < faces; ++f) face(full_line(), corners);
        if (brightest > 1)
            for (glm::vec3& c : mesh.colours) c /= 255.0f;
    }
};

} // namespace

std::vector<Level> read_off(std::string_view bytes, const std::filesystem::path&) {
    OffReader reader(bytes);
    reader.read();
    return one_level(std::move(reader.mesh));
}

bool write_off(FileSet& files, const std::filesystem::path& path, const Level& level) {
    const Mesh& mesh = level.mesh;
    Gather out(files.mesh(path));
    const bool colours = !mesh.colours.empty();
    out << (colours ? "COFF\n" : "OFF\n"); // no comment line: OpenMesh takes one for the counts
    out << mesh.positions.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3& p = mesh.positions[v];
        out << p.x << ' ' << p.y << ' ' << p.z;
        for (int k = 0; k < 3 && colours; ++k) out << ' ' << double(mesh.colours[v][k]);
        out << (colours ? " 1\n" : "\n");
    }
    for (const Triangle& t : mesh.triangles)
        out << "3 " << std::size_t(t[0]) << ' ' << std::size_t(t[1]) << ' ' << std::size_t(t[2]) << '\n';
    return out.flush();
}

} // namespace glcast::format
