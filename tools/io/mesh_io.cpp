#include "tools/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "capture/output_file.h"
#include "tools/io/input_file.h"
#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/mesh/face_colours.h"

namespace glcast {
namespace format {

void refuse(const std::string& why) { throw std::runtime_error(why); }

std::string material_name(const glm::vec3& colour) {
    const auto byte = [](float c) { return unsigned(std::lround(std::clamp(c, 0.0f, 1.0f) * 255)); };
    char name[32];
    std::snprintf(name, sizeof name, "colour_%02x%02x%02x", byte(colour.x), byte(colour.y), byte(colour.z));
    return name;
}

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

double diagonal(const Mesh& mesh) {
    const auto [lo, hi] = bounds(mesh);
    return glm::length(hi - lo);
}

glm::dvec3 origin_of_floats(const Mesh& mesh) {
    return needs_doubles(mesh) ? glm::round(centre(mesh)) : glm::dvec3(0);
}

std::string moved_by(const glm::dvec3& from) {
    std::string text = "(";
    for (int k = 0; k < 3; ++k) {
        char word[32];
        text.append(k ? ", " : "").append(word, std::to_chars(word, word + sizeof word, 0 - from[k]).ptr);
    }
    return text + ")";
}

bool floats_hold(const Mesh& mesh) {
    return std::ranges::all_of(mesh.positions,
                               [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)) == p; });
}

// IEC 61966-2-1
float to_linear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }
float to_display(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }

} // namespace format

namespace {

using Reader = std::vector<Level> (*)(std::string_view, const std::filesystem::path&);
/// A level to a file of the set, its texture to further ones.
using Writer = bool (*)(format::FileSet& files, const std::filesystem::path& path, const Level& level,
                        const WriteOptions& options);

struct Format {
    const char* extension;
    Reader read;
    Writer write;     ///< one level
    bool many_levels; ///< written by write_glb
};

constexpr Format formats[] = {
    {".glb", format::read_glb, nullptr, true},
    {".gltf", format::read_glb, nullptr, false},
    {".obj", format::read_obj, format::write_obj, false},
    {".ply", format::read_ply, format::write_ply, false},
    {".off", format::read_off, format::write_off, false},
    {".stl", format::read_stl, format::write_stl, false},
    {".3mf", format::read_3mf, format::write_3mf, false},
};

const Format& format_of(const std::filesystem::path& path) {
    std::string extension = path.extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const Format& f : formats)
        if (extension == f.extension) return f;
    format::refuse(
        "the format is told by the extension: .glb, .obj, .ply, .off, .stl, .3mf or .gltf (to read)");
}

std::string read_file(const std::filesystem::path& path) {
    const InputFile file(path);
    if (file.size() == 0) format::refuse("the file is empty");
    const std::vector<char> bytes = file.read(0, file.size());
    return {bytes.begin(), bytes.end()};
}

constexpr double farthest = 1.844e18; ///< Embree's: beyond it distances cannot be measured

void check_positions(const Mesh& mesh) {
    for (const glm::dvec3& p : mesh.positions) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            format::refuse("a position is not finite");
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > farthest)
            format::refuse("a position is more than 1.8e18 from the origin: scale the mesh down");
    }
}

/// Means of the normals of a vertex's triangles, by area.
std::vector<glm::vec3> geometric_normals(const Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t[0]];
        const glm::dvec3 area = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        for (const std::uint32_t v : t) sums[v] += area;
    }
    std::vector<glm::vec3> normals(sums.begin(), sums.end());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double size = glm::length(sums[v]);
        normals[v] = size > 0 && std::isfinite(size) ? glm::vec3(sums[v] / size) : glm::vec3(0, 0, 1);
    }
    return normals;
}

/// Of length 1; false when it has no direction.
bool to_unit(glm::vec3& n) {
    const double size = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (!(size > 0) || !std::isfinite(glm::dot(n, glm::vec3(1)))) return false;
    n = glm::vec3(glm::normalize(glm::dvec3(n) / size));
    return true;
}

/// Normals without a direction get the surface's.
void unit_normals(Level& level) {
    std::vector<glm::vec3> geometric;
    const auto mend = [&](glm::vec3& n, std::uint32_t vertex) {
        if (to_unit(n)) return;
        if (geometric.empty()) geometric = geometric_normals(level.mesh);
        n = geometric[vertex];
    };
    for (std::size_t v = 0; v < level.mesh.normals.size(); ++v) mend(level.mesh.normals[v], std::uint32_t(v));
    if (level.wedges.normals.empty()) return;
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k)
            mend(level.wedges.normals[level.wedges.corners[t][k]], level.mesh.triangles[t][k]);
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
    check_positions(mesh);
    if (mesh.normals.size() != vertices) mesh.normals.clear();
    if (mesh.colours.size() != vertices) mesh.colours.clear();
    if (!fits(mesh, level.wedges)) level.wedges = {};
    unit_normals(level);
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
        std::vector<Level> levels = f.read(bytes, path);
        for (Level& level : levels) tidy(level);
        if (levels.size() == 1) levels[0].set = marked_set(bytes);
        return levels;
    } catch (const std::bad_alloc&) {
        throw; // no fault of the file
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

std::string note_on(const std::filesystem::path& path, const Level& level) {
    const Format& f = format_of(path);
    if (f.write == format::write_obj || f.write == format::write_off) {
        const bool textured = !level.texture.empty() && f.write == format::write_obj;
        if (textured || level.wedges.colours.empty() ||
            (f.write == format::write_obj && !face_colours(level).empty()))
            return {};
        return path.string() + ": a vertex has one colour in " + f.extension +
               ": where several meet, that of its largest side; " +
               (f.write == format::write_obj ? "--texture keeps them" : ".glb and .ply keep them");
    }
    const glm::dvec3 from = format::origin_of_floats(level.mesh);
    if ((f.write != format::write_stl && f.write != format::write_3mf) || from == glm::dvec3(0)) return {};
    return path.string() + ": the model is moved by " + format::moved_by(from) +
           ", as floats would lose its digits where it is";
}

std::uint64_t glb_size(const Level& level) {
    return format::glb_bytes({&level, 1}, Compression::none).size();
}

void hold_in_floats(Mesh& mesh) {
    if (format::needs_doubles(mesh)) return;
    std::vector<std::array<float, 3>> rounded;
    for (const glm::dvec3& p : mesh.positions) rounded.push_back({float(p.x), float(p.y), float(p.z)});
    std::vector<std::array<float, 3>> sorted = rounded;
    tbb::parallel_sort(sorted);
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return;
    for (std::size_t v = 0; v < rounded.size(); ++v)
        mesh.positions[v] = glm::dvec3(rounded[v][0], rounded[v][1], rounded[v][2]);
}

void round_levels(std::span<Level> levels, Compression compression) {
    if (compression == Compression::none || levels.empty()) return;
    const format::PositionGrid grid = format::grid_for(levels);
    for (Level& level : levels) format::round_level(level, grid);
}

std::vector<std::filesystem::path> write_levels(const std::filesystem::path& path,
                                                std::span<const Level> levels, const WriteOptions& options) {
    const Format& f = format_of(path);
    if (!f.many_levels && (options.one_file || options.compression != Compression::none))
        format::refuse("only .glb is compressed, or holds several levels");
    if (levels.empty()) throw std::logic_error("no levels to write");
    format::FileSet files; // all are written before the first appears
    if (f.many_levels && options.one_file)
        format::write_glb(files.mesh(path), levels, options.compression);
    else if (f.many_levels)
        write_glbs(files, path, levels, options.compression);
    else
        for (std::size_t k = 0; k < levels.size(); ++k)
            f.write(files, level_path(path, k), levels[k], options);
    return files.commit();
}

} // namespace glcast
