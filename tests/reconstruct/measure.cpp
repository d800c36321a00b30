#include "tests/reconstruct/measure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <unordered_map>

namespace glcast::test {
namespace {

using glm::dvec3;

/// Ericson 2005, Real-Time Collision Detection, 5.1.5.
double point_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return length(ap);
    const dvec3 bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return length(bp);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 / (d1 - d3)));
    const dvec3 cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return length(cp);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 / (d2 - d6)));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    const double sum = va + vb + vc;
    return length(ap - ab * (vb / sum) - ac * (vc / sum));
}

void add(Distance& d, double value) {
    d.mean += value;
    d.max = std::max(d.max, value);
    ++d.points;
}

std::uint64_t key(int x, int y, int z) {
    return (std::uint64_t(x + 32768) << 32) | (std::uint64_t(y + 32768) << 16) | std::uint64_t(z + 32768);
}

} // namespace

Distance mesh_to_body(const Mesh& mesh, const Body& body, double sample) {
    Distance out;
    const auto at = [&](const dvec3& p) { add(out, std::abs(body.distance(p)) / sample); };
    for (const dvec3& p : mesh.positions) at(p);
    for (const Triangle& t : mesh.triangles) {
        const dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        at((a + b + c) / 3.0);
        at((a + b) / 2.0);
    }
    out.mean /= double(out.points);
    return out;
}

Distance points_to_mesh(const std::vector<dvec3>& points, const Mesh& mesh, double sample) {
    const double cell = 2 * sample;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> grid;
    const auto index = [&](double x) { return int(std::floor(x / cell)); };
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const dvec3& p = mesh.positions[mesh.triangles[i][0]];
        grid[key(index(p.x), index(p.y), index(p.z))].push_back(i);
    }
    Distance out;
    for (const dvec3& p : points) {
        double least = 1e300;
        for (int reach = 1; reach <= 24 && least > cell * (reach - 1); ++reach)
            for (int z = -reach; z <= reach; ++z)
                for (int y = -reach; y <= reach; ++y)
                    for (int x = -reach; x <= reach; ++x) {
                        const auto found = grid.find(key(index(p.x) + x, index(p.y) + y, index(p.z) + z));
                        if (found == grid.end()) continue;
                        for (std::uint32_t i : found->second) {
                            const Triangle& t = mesh.triangles[i];
                            least =
                                std::min(least, point_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                                               mesh.positions[t[2]]));
                        }
                    }
        add(out, least / sample);
    }
    out.mean /= double(std::max<std::size_t>(out.points, 1));
    return out;
}

Topology topology(const Mesh& mesh) {
    Topology out;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> links(mesh.positions.size());
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            ++directed[{t[k], t[(k + 1) % 3]}];
            links[t[k]].push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
            parent[root(t[k])] = root(t[0]);
        }
        out.volume += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
    }
    for (const auto& [edge, count] : directed) {
        const auto back = directed.find({edge.second, edge.first});
        if (count != 1 || back == directed.end() || back->second != 1) ++out.bad_edges;
    }
    for (std::size_t v = 0; v < links.size(); ++v) {
        if (links[v].empty()) {
            ++out.unused;
            continue;
        }
        std::map<std::uint32_t, std::uint32_t> next(links[v].begin(), links[v].end());
        std::uint32_t at = links[v][0].first;
        std::size_t steps = 0;
        do {
            const auto found = next.find(at);
            if (found == next.end()) break;
            at = found->second;
        } while (++steps < links[v].size() && at != links[v][0].first);
        if (at != links[v][0].first || steps != links[v].size()) ++out.bad_vertices;
        out.components += root(std::uint32_t(v)) == v;
    }
    out.euler = long(mesh.positions.size()) - long(directed.size() / 2) + long(mesh.triangles.size());
    return out;
}

std::ostream& operator<<(std::ostream& out, const Topology& t) {
    return out << t.bad_edges << " bad edges, " << t.bad_vertices << " bad vertices, " << t.unused
               << " unused, " << t.components << " components, Euler " << t.euler;
}

} // namespace glcast::test
