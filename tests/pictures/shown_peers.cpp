#include "tests/pictures/shown_peers.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "tests/paper/originals.h"
#include "tests/peers/simplify_peers.h"
#include "tests/pictures/creases.h"
#include "tools/deviation/surface_index.h"
#include "tools/mesh/point_triangle.h"

namespace glcast::pictures {
namespace {

const double crease = std::cos(35 * std::numbers::pi / 180);
constexpr double inwards =
    0.05; // of the way from a corner to the middle of its side: no longer on the crease

template <class T> T mixed(const std::array<T, 3>& of, const glm::dvec3& weights) {
    return of[0] * float(weights.x) + of[1] * float(weights.y) + of[2] * float(weights.z);
}

/// Where the normal that is shown is far from the side's own, it belongs to another side.
glm::vec3 normal_of_side(const glm::vec3& shown, const glm::dvec3& own) {
    const double length = glm::length(shown);
    if (length > 0 && glm::dot(glm::dvec3(shown), own) > crease * length) return shown / float(length);
    return own == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(own);
}

/// Of the nearest point of the surface that faces as a side does.
Level with_attributes(Mesh mesh, const Level& surface) {
    const Sides sides = sides_of_creases(mesh, crease);
    const SurfaceIndex index(surface.mesh);
    std::vector<glm::vec3> normals(sides.vertex.size()), colours(sides.vertex.size());
    const bool coloured = has_colours(surface.mesh, surface.wedges);
    for (std::size_t side = 0; side < normals.size(); ++side) {
        const glm::dvec3 corner = mesh.positions[sides.vertex[side]];
        const glm::dvec3 at = corner + inwards * (sides.middles[side] - corner);
        const auto found = index.nearest_facing(at, sides.normals[side], index.nearest(at));
        const auto corners = index.corners(found.triangle);
        const glm::dvec3 weights = nearest_in_triangle(at, corners[0], corners[1], corners[2]).weights;
        normals[side] =
            normal_of_side(mixed(corner_normals(surface.mesh, surface.wedges, found.triangle), weights),
                           sides.normals[side]);
        if (coloured)
            colours[side] = mixed(corner_colours(surface.mesh, surface.wedges, found.triangle), weights);
    }
    CornerValues of_normals(mesh.triangles.size()), of_colours(coloured ? mesh.triangles.size() : 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            of_normals[t][k] = normals[sides.of_corner[t][k]];
            if (coloured) of_colours[t][k] = colours[sides.of_corner[t][k]];
        }
    Level level{std::move(mesh), ""};
    level.wedges = take_corner_values(level.mesh, of_normals, of_colours);
    return level;
}

/// A file between programs: tests/peers/meshoptimizer.mjs says what is in it.
struct Exchange {
    std::vector<float> positions, attributes;
    std::vector<std::uint32_t> corners;

    void write(const std::filesystem::path& path) const {
        std::ofstream file(path, std::ios::binary);
        const std::uint32_t head[] = {std::uint32_t(positions.size() / 3), std::uint32_t(corners.size() / 3)};
        const auto put = [&](const auto* data, std::size_t count) {
            file.write(reinterpret_cast<const char*>(data), std::streamsize(count * sizeof *data));
        };
        put(head, 2), put(positions.data(), positions.size());
        put(attributes.data(), attributes.size()), put(corners.data(), corners.size());
        if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
    }
    static Exchange read(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        std::uint32_t head[2] = {0, 0};
        Exchange from;
        const auto take = [&](auto* data, std::size_t count) {
            file.read(reinterpret_cast<char*>(data), std::streamsize(count * sizeof *data));
        };
        take(head, 2);
        from.positions.resize(3UL * head[0]), from.attributes.resize(6UL * head[0]);
        from.corners.resize(3UL * head[1]);
        take(from.positions.data(), from.positions.size());
        take(from.attributes.data(), from.attributes.size());
        take(from.corners.data(), from.corners.size());
        if (!file || from.corners.empty()) throw std::runtime_error("cannot read " + path.string());
        return from;
    }
};

Exchange positions_of(const Mesh& mesh) {
    Exchange made;
    for (const glm::dvec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k) made.positions.push_back(float(p[k]));
    made.attributes.resize(2 * made.positions.size());
    for (const Triangle& t : mesh.triangles) made.corners.insert(made.corners.end(), t.begin(), t.end());
    return made;
}

/// A vertex for each wedge.
Exchange all_of(const Level& surface) {
    const bool split = !surface.wedges.empty(), coloured = has_colours(surface.mesh, surface.wedges);
    std::size_t count = surface.mesh.positions.size();
    if (split) count = std::max(surface.wedges.normals.size(), surface.wedges.colours.size());
    Exchange made;
    made.positions.resize(3 * count), made.attributes.resize(6 * count);
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        const Triangle& vertices = surface.mesh.triangles[t];
        const auto normals = corner_normals(surface.mesh, surface.wedges, t);
        std::array<glm::vec3, 3> colours{};
        if (coloured) colours = corner_colours(surface.mesh, surface.wedges, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t at = split ? surface.wedges.corners[t][k] : vertices[k];
            made.corners.push_back(at);
            for (int i = 0; i < 3; ++i) {
                made.positions[3 * at + std::size_t(i)] = float(surface.mesh.positions[vertices[k]][i]);
                made.attributes[6 * at + std::size_t(i)] = normals[k][i];
                made.attributes[6 * at + 3 + std::size_t(i)] = colours[k][i];
            }
        }
    }
    return made;
}

Mesh mesh_of(const Exchange& made) {
    Mesh mesh;
    for (std::size_t i = 0; i < made.positions.size(); i += 3)
        mesh.positions.emplace_back(made.positions[i], made.positions[i + 1], made.positions[i + 2]);
    for (std::size_t i = 0; i < made.corners.size(); i += 3)
        mesh.triangles.push_back({made.corners[i], made.corners[i + 1], made.corners[i + 2]});
    return mesh;
}

/// Runs a program that takes two files and a number.
Exchange run(const std::string& program, const Exchange& input, std::size_t triangles,
             const std::string& after = "") {
    std::string folder = std::filesystem::temp_directory_path() / "peer-XXXXXX";
    if (!mkdtemp(folder.data())) throw std::runtime_error("cannot make a folder for a peer's files");
    struct Removed {
        std::filesystem::path path;
        ~Removed() { std::filesystem::remove_all(path); }
    } const removed{folder};
    const std::filesystem::path in = removed.path / "in", out = removed.path / "out";
    input.write(in);
    const std::string command = program + " '" + in.string() + "' '" + out.string() + "' " +
                                std::to_string(triangles) + " " + after + " >/dev/null";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    return Exchange::read(out);
}

Level by_meshoptimizer(const Level& surface, std::size_t triangles, const std::string& how) {
    const Exchange made = run("node '" PEERS "/meshoptimizer.mjs'", all_of(surface), triangles, how);
    Level level{mesh_of(made), ""};
    const bool coloured = has_colours(surface.mesh, surface.wedges);
    for (std::size_t v = 0; v < level.mesh.positions.size(); ++v) {
        const float* at = made.attributes.data() + 6 * v;
        const glm::vec3 normal(at[0], at[1], at[2]);
        level.mesh.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::vec3(0, 0, 1));
        if (coloured) level.mesh.colours.push_back(glm::clamp(glm::vec3(at[3], at[4], at[5]), 0.F, 1.F));
    }
    return level;
}

/// The program's own mesh has its vertices doubled; a cast is joined already.
Mesh joined(const Level& surface) {
    Mesh mesh = surface.wedges.empty() ? paper::welded(surface.mesh) : surface.mesh;
    mesh.normals.clear(), mesh.colours.clear();
    return mesh;
}

Level by_name(const Level& surface, std::size_t triangles, const std::string& name) {
    for (const test::SimplifyPeer& peer : test::simplify_peers())
        if (peer.name == name) return with_attributes(peer.run(joined(surface), triangles).mesh, surface);
    throw std::logic_error("no peer " + name);
}

Level by_blender(const Level& surface, std::size_t triangles) {
    const std::string program =
        "blender -b --factory-startup --python-exit-code 1 --python '" PEERS "/blender_collapse.py' --";
    return with_attributes(mesh_of(run(program, positions_of(joined(surface)), triangles)), surface);
}

} // namespace

Level split_at_creases(const Level& surface) {
    Level level = surface;
    const Sides sides = sides_of_creases(level.mesh, crease);
    CornerValues normals(level.mesh.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t) {
        const auto shown = corner_normals(surface.mesh, surface.wedges, t);
        for (std::size_t k = 0; k < 3; ++k)
            normals[t][k] = normal_of_side(shown[k], sides.normals[sides.of_corner[t][k]]);
    }
    level.wedges = take_corner_values(level.mesh, normals, {});
    return level;
}

const std::vector<ShownPeer>& shown_peers() {
    static const std::vector<ShownPeer> all = {
        {"meshoptimizer, attributes",
         [](const Level& surface, std::size_t count) {
             return by_meshoptimizer(surface, count, "attributes");
         }},
        {"meshoptimizer, update",
         [](const Level& surface, std::size_t count) { return by_meshoptimizer(surface, count, "update"); }},
        {"CGAL, Garland and Heckbert",
         [](const Level& surface, std::size_t count) {
             return by_name(surface, count, "CGAL, Garland and Heckbert");
         }},
        {"CGAL, Lindstrom and Turk",
         [](const Level& surface, std::size_t count) {
             return by_name(surface, count, "CGAL, Lindstrom and Turk");
         }},
        {"Blender, collapse", by_blender},
        {"OpenMesh",
         [](const Level& surface, std::size_t count) {
             return by_name(surface, count, "OpenMesh DecimaterT, ModQuadricT");
         }},
    };
    return all;
}

} // namespace glcast::pictures
