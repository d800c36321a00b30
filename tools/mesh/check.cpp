#include "tools/mesh/check.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "tools/mesh/intersections.h"

namespace glcast {
namespace {

/// What a triangle is to one of its corners v: it runs v -> next -> prev -> v.
struct Corner {
    std::uint32_t next, prev;
};

bool usable(const Triangle& t, std::size_t vertices) {
    return t[0] < vertices && t[1] < vertices && t[2] < vertices && t[0] != t[1] && t[1] != t[2] &&
           t[2] != t[0];
}

/// The corners at each vertex, in one array sorted by vertex (compressed rows).
struct Corners {
    std::vector<std::size_t> first; ///< corners of v: first[v] .. first[v + 1]
    std::vector<Corner> all;

    explicit Corners(const Mesh& mesh) : first(mesh.positions.size() + 1, 0) {
        const std::size_t vertices = mesh.positions.size();
        for (const Triangle& t : mesh.triangles)
            if (usable(t, vertices))
                for (std::uint32_t v : t) ++first[v + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        all.resize(first.back());
        std::vector<std::size_t> fill(first.begin(), first.end() - 1);
        for (const Triangle& t : mesh.triangles)
            if (usable(t, vertices))
                for (int k = 0; k < 3; ++k) all[fill[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
    }
};

/// Smallest root wins, paths are halved: components of vertices.
class UnionFind {
  public:
    explicit UnionFind(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
    std::uint32_t root(std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent;
};

/// Edges from v to larger neighbours, so that each edge is counted once. `links`: neighbour and whether the
/// edge runs outwards from v, 0 or 1; scratch.
void count_edges(std::uint32_t v, const Corner* begin, const Corner* end,
                 std::vector<std::pair<std::uint32_t, int>>& links, MeshCheck& check) {
    links.clear();
    for (const Corner* c = begin; c != end; ++c) {
        if (c->next > v) links.emplace_back(c->next, 1);
        if (c->prev > v) links.emplace_back(c->prev, 0);
    }
    std::sort(links.begin(), links.end());
    for (std::size_t i = 0; i < links.size();) {
        std::size_t out = 0, in = 0;
        const std::uint32_t neighbour = links[i].first;
        for (; i < links.size() && links[i].first == neighbour; ++i) ++(links[i].second ? out : in);
        ++check.edges;
        if (out + in == 1)
            ++check.boundary_edges;
        else if (out != 1 || in != 1)
            ++check.non_manifold_edges;
    }
}

/// Do the corners, sorted by `next`, make one fan? Walks from corner to corner over shared edges.
bool is_one_fan(Corner* begin, Corner* end, std::vector<std::uint32_t>& prevs) {
    const auto by_next = [](const Corner& a, const Corner& b) { return a.next < b.next; };
    std::sort(begin, end, by_next);
    prevs.clear();
    for (Corner* c = begin; c != end; ++c) prevs.push_back(c->prev);
    std::sort(prevs.begin(), prevs.end());
    Corner* start = begin;
    for (Corner* c = begin; c != end; ++c) // an open fan starts at the corner that no other leads to
        if (!std::binary_search(prevs.begin(), prevs.end(), c->next)) start = c;
    const std::size_t degree = end - begin;
    std::size_t steps = 1;
    for (Corner* at = start; steps <= degree; ++steps) {
        const std::uint32_t wanted = at->prev;
        at = std::lower_bound(begin, end, Corner{wanted, 0}, by_next);
        if (at == end || at->next != wanted || at == start) break;
        if (steps == degree) return false; // runs in a loop that its start is not part of
    }
    return steps == degree;
}

glm::dvec3 centre_of(const Mesh& mesh) {
    if (mesh.positions.empty()) return glm::dvec3(0);
    glm::dvec3 lo = mesh.positions[0], hi = lo;
    for (const glm::dvec3& p : mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return (lo + hi) * 0.5;
}

/// Volume and area about the centre, so that a mesh far from the origin loses no digits.
void measure(const Mesh& mesh, MeshCheck& check) {
    const glm::dvec3 centre = centre_of(mesh);
    for (const Triangle& t : mesh.triangles) {
        if (!usable(t, mesh.positions.size())) {
            ++check.degenerate_triangles;
            continue;
        }
        const glm::dvec3 a = mesh.positions[t[0]] - centre, b = mesh.positions[t[1]] - centre,
                         c = mesh.positions[t[2]] - centre;
        check.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        check.area += glm::length(glm::cross(b - a, c - a)) / 2.0;
    }
}

void count_components(const Mesh& mesh, const Corners& corners, MeshCheck& check) {
    UnionFind sets(mesh.positions.size());
    for (const Triangle& t : mesh.triangles)
        if (usable(t, mesh.positions.size())) sets.join(t[0], t[1]), sets.join(t[1], t[2]);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        if (corners.first[v] != corners.first[v + 1] && sets.root(v) == v) ++check.components;
}

/// What is counted around a vertex.
void add(MeshCheck& sum, const MeshCheck& more) {
    for (std::size_t MeshCheck::*count :
         {&MeshCheck::edges, &MeshCheck::boundary_edges, &MeshCheck::non_manifold_edges,
          &MeshCheck::non_manifold_vertices, &MeshCheck::unused_vertices})
        sum.*count += more.*count;
}

/// Edges and fans; sorts the corners of each vertex.
MeshCheck check_vertices(const Mesh& mesh, Corners& corners) {
    tbb::enumerable_thread_specific<MeshCheck> counts;
    const tbb::blocked_range<std::uint32_t> vertices(0, std::uint32_t(mesh.positions.size()), 4096);
    tbb::parallel_for(vertices, [&](const auto& range) {
        MeshCheck& check = counts.local();
        std::vector<std::pair<std::uint32_t, int>> links;
        std::vector<std::uint32_t> prevs;
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
            Corner *begin = corners.all.data() + corners.first[v],
                   *end = corners.all.data() + corners.first[v + 1];
            if (begin == end) {
                ++check.unused_vertices;
                continue;
            }
            count_edges(v, begin, end, links, check);
            if (!is_one_fan(begin, end, prevs)) ++check.non_manifold_vertices;
        }
    });
    MeshCheck sum;
    for (const MeshCheck& check : counts) add(sum, check);
    return sum;
}

} // namespace

static void count_crossings(const Mesh& mesh, MeshCheck& check) {
    const PairCount count = count_pairs_that_meet(mesh.positions, mesh.triangles);
    check.self_intersections = count.pairs;
    check.more_self_intersections = !count.complete;
}

MeshCheck check_mesh(const Mesh& mesh, CheckDepth depth) {
    MeshCheck check;
    if (depth == CheckDepth::everything) count_crossings(mesh, check);
    check.vertices = mesh.positions.size();
    check.triangles = mesh.triangles.size();
    std::optional<Corners> corners;
    tbb::parallel_invoke([&] { measure(mesh, check); }, [&] { corners.emplace(mesh); });
    MeshCheck around;
    tbb::parallel_invoke([&] { count_components(mesh, *corners, check); },
                         [&] { around = check_vertices(mesh, *corners); });
    add(check, around);
    check.euler = static_cast<long>(check.vertices - check.unused_vertices) - static_cast<long>(check.edges) +
                  static_cast<long>(check.triangles - check.degenerate_triangles);
    return check;
}

namespace {

std::string describe_topology(const MeshCheck& check) {
    if (check.closed_manifold()) return "closed two-manifold";
    if (check.triangles == 0) return "no triangles";
    const std::pair<std::size_t, const char*> faults[] = {
        {check.boundary_edges, "boundary edge"},
        {check.non_manifold_edges, "non-manifold edge"},
        {check.non_manifold_vertices, "non-manifold vertex"},
        {check.degenerate_triangles, "degenerate triangle"},
    };
    std::string text;
    for (const auto& [count, what] : faults) {
        if (count == 0) continue;
        std::string plural = what;
        if (count > 1)
            plural = plural.ends_with("ex") ? plural.substr(0, plural.size() - 2) + "ices" : plural + "s";
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + plural;
    }
    return text;
}

} // namespace

std::string describe(const MeshCheck& check) {
    std::string text = describe_topology(check);
    if (!check.self_intersections) return text;
    const std::size_t pairs = *check.self_intersections;
    if (check.more_self_intersections)
        return text + ", more than " + std::to_string(pairs) + " self-intersections";
    text += pairs ? ", " + std::to_string(pairs) : ", no";
    return text + (pairs == 1 ? " self-intersection" : " self-intersections");
}

} // namespace glcast
