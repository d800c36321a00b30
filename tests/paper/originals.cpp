#include "tests/paper/originals.h"

#include <map>
#include <numeric>
#include <tuple>

#include "fixtures/shapes.h"
#include "fixtures/teapot_patches.h"

namespace glcast::paper {
namespace {

using fixtures::ControlNet;
using fixtures::evaluate;

void add_patch(Mesh& mesh, const ControlNet& net, int nu, int nv) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i)
            mesh.positions.push_back(evaluate(net, double(i) / nu, double(j) / nv).position);
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            const auto a = first + std::uint32_t(j * (nu + 1) + i), b = a + 1, c = a + std::uint32_t(nu + 1);
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({b, c + 1, c});
        }
}

/// Where two parts touch in a vertex (the handle's end lies on a vertex of the body), each gets its own.
void part_fans(Mesh& mesh) {
    const std::size_t corners = mesh.triangles.size() * 3;
    std::vector<std::size_t> fan(corners); // union-find over the corners of triangles
    std::iota(fan.begin(), fan.end(), 0);
    const auto root = [&](std::size_t c) {
        while (fan[c] != c) c = fan[c] = fan[fan[c]];
        return c;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edge; // directed, to the corner it leaves
    const auto corner = [&](std::size_t c) { return mesh.triangles[c / 3][c % 3]; };
    const auto next = [](std::size_t c) { return c / 3 * 3 + (c + 1) % 3; };
    for (std::size_t c = 0; c < corners; ++c) edge[{corner(c), corner(next(c))}] = c;
    for (const auto& [ends, c] : edge)
        if (const auto back = edge.find({ends.second, ends.first}); back != edge.end()) {
            fan[root(c)] = root(next(back->second));
            fan[root(next(c))] = root(back->second);
        }
    std::vector<std::size_t> first(mesh.positions.size(), corners);
    std::map<std::size_t, std::uint32_t> own;
    for (std::size_t c = 0; c < corners; ++c) {
        std::uint32_t& v = mesh.triangles[c / 3][c % 3];
        if (first[v] == corners) first[v] = root(c);
        if (first[v] == root(c)) continue;
        const auto [at, is_new] = own.try_emplace(root(c), std::uint32_t(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(mesh.positions[v]), first.push_back(root(c));
        v = at->second;
    }
}

} // namespace

Mesh welded(const Mesh& mesh) {
    Mesh result;
    std::map<std::tuple<long, long, long>, std::uint32_t> seen;
    std::vector<std::uint32_t> number;
    for (const glm::dvec3& p : mesh.positions) {
        const auto key = std::tuple(std::lround(p.x * 1e6 + 0.1234567), std::lround(p.y * 1e6 + 0.1234567),
                                    std::lround(p.z * 1e6 + 0.1234567));
        const auto [at, is_new] = seen.try_emplace(key, std::uint32_t(result.positions.size()));
        if (is_new) result.positions.push_back(p);
        number.push_back(at->second);
    }
    for (const Triangle& t : mesh.triangles) {
        const Triangle moved = {number[t[0]], number[t[1]], number[t[2]]};
        if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0])
            result.triangles.push_back(moved);
    }
    part_fans(result);
    return result;
}

Mesh teapot(int cells, bool flat_bottom) {
    Mesh mesh;
    for (const fixtures::TeapotPatch& patch : fixtures::teapot_patches()) {
        const bool bottom = patch.net.pole == ControlNet::Pole::last_u;
        for (const fixtures::Placement& placement : patch.copies)
            add_patch(mesh, put(patch.net, placement), bottom && flat_bottom ? 1 : cells, cells);
    }
    return welded(mesh);
}

Mesh spheres(int fineness) { return fixtures::truth("spheres", fineness); }

} // namespace glcast::paper
