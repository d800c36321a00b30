#include "tools/io/mesh_io.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "capture/output_file.h"
#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"

namespace glcast {
namespace format {

void refuse(const std::string& why) { throw std::runtime_error(why); }

std::vector<Level> one_level(Mesh mesh) {
    std::vector<Level> levels(1);
    levels[0].mesh = std::move(mesh);
    levels[0].name = "level 0";
    return levels;
}

static std::pair<glm::dvec3, glm::dvec3> bounds(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    glm::dvec3 lo = mesh.positions[0], hi = lo;
    for (const glm::dvec3& p : mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return {lo, hi};
}

glm::dvec3 centre(const Mesh& mesh) {
    const auto [lo, hi] = bounds(mesh);
    return (lo + hi) * 0.5;
}

bool needs_doubles(const Mesh& mesh) {
    const auto [lo, hi] = bounds(mesh);
    const glm::dvec3 far = glm::max(glm::abs(lo), glm::abs(hi));
    return std::max({far.x, far.y, far.z}) > 16 * glm::length(hi - lo);
}

void add_fan(Mesh& mesh, std::span<const std::uint32_t> corners) {
    for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

// IEC 61966-2-1
float to_linear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }
float to_display(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }

} // namespace format

namespace {

using Reader = std::vector<Level> (*)(std::string_view);
/// A level to a file of the set, its texture to further ones.
using Writer = bool (*)(format::FileSet& files, const std::filesystem::path& path, const Level& level);

struct Format {
    const char* extension;
    Reader read;
    Writer write;     ///< one level
    bool many_levels; ///< written by write_glb
};

constexpr Format formats[] = {
    {".glb", format::read_glb, nullptr, true},
    {".obj", format::read_obj, format::write_obj, false},
    {".ply", format::read_ply, format::write_ply, false},
    {".off", format::read_off, format::write_off, false},
    {".stl", format::read_stl, nullptr, false},
};

const Format& format_of(const std::filesystem::path& path) {
    std::string extension = path.extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const Format& f : formats)
        if (extension == f.extension) return f;
    format::refuse("the format is told by the extension: .glb, .obj, .ply, .off or (to read) .stl");
}

std::string read_file(const std::filesystem::path& path) {
    std::error_code code;
    if (std::filesystem::is_directory(path, code)) format::refuse("is a folder");
    std::ifstream file(path, std::ios::binary);
    if (!file) format::refuse(std::strerror(errno));
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.empty()) format::refuse("the file is empty");
    return bytes;
}

/// What must be true of a mesh from anywhere: corners that exist, finite positions, unit normals, colours in
/// 0..1.
void tidy(Level& level) {
    Mesh& mesh = level.mesh;
    if (mesh.triangles.empty()) format::refuse("holds no triangles");
    const std::size_t vertices = mesh.positions.size();
    for (const Triangle& t : mesh.triangles)
        for (std::uint32_t v : t)
            if (v >= vertices)
                format::refuse("a face has corner " + std::to_string(v) + " of " + std::to_string(vertices) +
                               " vertices");
    for (const glm::dvec3& p : mesh.positions)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            format::refuse("a position is not finite");
    if (mesh.normals.size() != vertices) mesh.normals.clear();
    if (mesh.colours.size() != vertices) mesh.colours.clear();
    if (!fits(mesh, level.wedges)) level.wedges = {};
    for (auto* normals : {&mesh.normals, &level.wedges.normals})
        for (glm::vec3& n : *normals) {
            const float length = glm::length(n);
            n = std::isfinite(length) && length > 0 ? n / length : glm::vec3(0, 0, 1);
        }
    for (auto* colours : {&mesh.colours, &level.wedges.colours})
        for (glm::vec3& c : *colours)
            for (int k = 0; k < 3; ++k) c[k] = std::isnan(c[k]) ? 0 : std::clamp(c[k], 0.0f, 1.0f);
}

/// A file each; pictures are packed on all cores.
void write_glbs(format::FileSet& files, const std::filesystem::path& path, std::span<const Level> levels,
                Compression compression) {
    const format::PositionGrid grid = format::grid_for(levels);
    std::vector<OutputFile*> open;
    for (std::size_t k = 0; k < levels.size(); ++k) open.push_back(&files.mesh(level_path(path, k)));
    tbb::parallel_for(std::size_t(0), levels.size(), [&](std::size_t k) {
        format::write_glb(*open[k], levels.subspan(k, 1), compression, &grid);
    });
}

} // namespace

std::vector<Level> read_levels(const std::filesystem::path& path) {
    try {
        const Format& f = format_of(path);
        const std::string bytes = read_file(path);
        std::vector<Level> levels = f.read(bytes);
        for (Level& level : levels) tidy(level);
        if (levels.size() == 1) levels[0].set = marked_set(bytes);
        return levels;
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot read mesh '" + path.string() + "': " + e.what());
    }
}

std::vector<Level> read_all_levels(const std::filesystem::path& path) {
    std::vector<Level> levels = read_levels(path);
    if (levels.size() > 1) return levels;
    for (const std::filesystem::path& beside : levels_beside(path, levels[0].set))
        levels.push_back(std::move(read_levels(beside).front()));
    return levels;
}

Mesh read_mesh(const std::filesystem::path& path) { return std::move(read_levels(path).front().mesh); }

std::uint64_t glb_size(const Level& level) { return format::glb_bytes({&level, 1}, Compression::none).size(); }

void round_levels(std::span<Level> levels, Compression compression) {
    if (compression == Compression::none || levels.empty()) return;
    const format::PositionGrid grid = format::grid_for(levels);
    for (Level& level : levels) format::round_level(level, grid);
}

std::vector<std::filesystem::path> write_levels(const std::filesystem::path& path, std::span<const Level> levels,
                                                const WriteOptions& options) {
    const Format& f = format_of(path);
    if (!f.write && !f.many_levels)
        format::refuse("cannot write '" + path.string() + "': " + f.extension +
                       " is read only; take .glb, .obj, .ply or .off");
    if (!f.many_levels && (options.one_file || options.compression != Compression::none))
        format::refuse("only .glb is compressed, or holds several levels");
    if (levels.empty()) throw std::logic_error("no levels to write");
    format::FileSet files; // all are written before the first appears
    if (f.many_levels && options.one_file)
        format::write_glb(files.mesh(path), levels, options.compression);
    else if (f.many_levels)
        write_glbs(files, path, levels, options.compression);
    else
        for (std::size_t k = 0; k < levels.size(); ++k) f.write(files, level_path(path, k), levels[k]);
    return files.commit();
}

} // namespace glcast
