#include "tests/progressive/shortest_edge.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <queue>
#include <set>

namespace glcast::test {
namespace {

struct Entry {
    double length;
    std::uint32_t a, b;
    std::size_t stamp; ///< of both ends together, when it was measured
    bool operator<(const Entry& other) const {
        return std::tie(other.length, other.a, other.b) < std::tie(length, a, b);
    }
};

class Run {
  public:
    Run(const Mesh& from, Placement placement, unsigned seed)
        : mesh(from), placement(placement), random(seed), alive(from.positions.size(), true),
          triangle_alive(from.triangles.size(), true), around(from.positions.size()),
          stamp(from.positions.size()), left(from.triangles.size()) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t v : mesh.triangles[t]) around[v].insert(t);
        for (std::uint32_t v = 0; v < around.size(); ++v) measure(v, true);
    }

    std::size_t triangles() const { return left; }

    bool step(CollapseLog& log) {
        while (!queue.empty()) {
            const Entry e = queue.top();
            queue.pop();
            if (!alive[e.a] || !alive[e.b] || e.stamp != stamp[e.a] + stamp[e.b] || !may_go(e.a, e.b))
                continue;
            collapse(e.a, e.b, log);
            return true;
        }
        return false;
    }

    /// What is left, by another road than the code under test takes: through sorted maps.
    Mesh remains() const {
        Mesh out;
        std::map<std::uint32_t, std::uint32_t> index;
        for (std::uint32_t v = 0; v < alive.size(); ++v) {
            if (!alive[v]) continue;
            index.emplace(v, std::uint32_t(out.positions.size()));
            out.positions.push_back(mesh.positions[v]);
            if (!mesh.colours.empty()) out.colours.push_back(mesh.colours[v]);
            if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[v]);
        }
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            if (triangle_alive[t])
                out.triangles.push_back({index.at(mesh.triangles[t][0]), index.at(mesh.triangles[t][1]),
                                         index.at(mesh.triangles[t][2])});
        return out;
    }

  private:
    std::set<std::uint32_t> neighbours(std::uint32_t v) const {
        std::set<std::uint32_t> all;
        for (const std::uint32_t t : around[v])
            for (const std::uint32_t w : mesh.triangles[t])
                if (w != v) all.insert(w);
        return all;
    }
    int shared(std::uint32_t a, std::uint32_t b) const {
        return int(
            std::count_if(around[a].begin(), around[a].end(), [&](auto t) { return around[b].count(t); }));
    }
    bool on_boundary(std::uint32_t v) const {
        const auto all = neighbours(v);
        return std::any_of(all.begin(), all.end(), [&](std::uint32_t w) { return shared(v, w) == 1; });
    }
    bool has_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return std::any_of(around[a].begin(), around[a].end(),
                           [&](auto t) { return around[b].count(t) && around[c].count(t); });
    }

    bool may_go(std::uint32_t a, std::uint32_t b) const {
        const auto of_a = neighbours(a), of_b = neighbours(b);
        std::vector<std::uint32_t> common;
        std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
        const int sides = shared(a, b);
        if (sides < 1 || sides > 2 || int(common.size()) != sides) return false;
        if (sides == 2) {
            if (on_boundary(a) && on_boundary(b)) return false;
            return !(has_triangle(a, common[0], common[1]) && has_triangle(b, common[0], common[1]));
        }
        return !(shared(a, common[0]) == 1 && shared(b, common[0]) == 1);
    }

    void collapse(std::uint32_t kept, std::uint32_t removed, CollapseLog& log) {
        if (random() % 2) std::swap(kept, removed);
        Collapse c{kept, removed, mesh.positions[kept], {}, {}};
        if (!mesh.colours.empty()) c.colour = mesh.colours[kept];
        if (!mesh.normals.empty()) c.normal = mesh.normals[kept];
        if (placement == Placement::middle) place(c);
        for (const std::uint32_t t : around[removed]) {
            Triangle& corners = mesh.triangles[t];
            if (around[kept].count(t)) {
                triangle_alive[t] = false, --left;
                for (const std::uint32_t v : corners)
                    if (v != removed) around[v].erase(t);
            } else {
                std::replace(corners.begin(), corners.end(), removed, kept);
                around[kept].insert(t);
            }
        }
        alive[removed] = false;
        mesh.positions[kept] = c.position;
        if (!mesh.colours.empty()) mesh.colours[kept] = c.colour;
        if (!mesh.normals.empty()) mesh.normals[kept] = c.normal;
        log.push_back(c);
        ++stamp[kept];
        for (const std::uint32_t v : neighbours(kept)) ++stamp[v];
        measure(kept, false);
        for (const std::uint32_t v : neighbours(kept)) measure(v, false);
    }

    void place(Collapse& c) {
        const glm::dvec3 a = mesh.positions[c.kept], b = mesh.positions[c.removed];
        std::uniform_real_distribution<double> off(-0.01, 0.01);
        c.position = 0.5 * (a + b) + glm::length(b - a) * glm::dvec3(off(random), off(random), off(random));
        if (!mesh.colours.empty()) c.colour = 0.5f * (mesh.colours[c.kept] + mesh.colours[c.removed]);
        if (!mesh.normals.empty())
            c.normal = glm::normalize(mesh.normals[c.kept] + 0.9f * mesh.normals[c.removed]);
    }

    void measure(std::uint32_t v, bool once) {
        for (const std::uint32_t w : neighbours(v))
            if (!once || v < w)
                queue.push({glm::length(mesh.positions[v] - mesh.positions[w]), std::min(v, w),
                            std::max(v, w), stamp[v] + stamp[w]});
    }

    Mesh mesh;
    Placement placement;
    std::mt19937 random;
    std::vector<bool> alive, triangle_alive;
    std::vector<std::set<std::uint32_t>> around;
    std::vector<std::size_t> stamp;
    std::priority_queue<Entry> queue;
    std::size_t left;
};

} // namespace

Collapses shortest_edges(const Mesh& mesh, std::size_t triangles, Placement placement, unsigned seed,
                         std::size_t every) {
    Collapses out;
    Run run(mesh, placement, seed);
    if (every) out.meshes.push_back(run.remains());
    while (run.triangles() > triangles && run.step(out.log))
        if (every && out.log.size() % every == 0) out.meshes.push_back(run.remains());
    return out;
}

} // namespace glcast::test
