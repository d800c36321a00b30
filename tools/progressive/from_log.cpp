// A run of collapses, played once from fine to coarse and written down backwards.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/progressive/order.h"
#include "tools/progressive/progressive_mesh.h"

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

[[noreturn]] void refuse(const std::string& why) {
    throw std::runtime_error("the log of collapses is not one of this mesh: " + why);
}

/// The corners at each vertex as a linked list, so that two vertices become one in no time. Corners of
/// triangles that are gone stay in the lists.
class Corners {
  public:
    explicit Corners(const Mesh& mesh)
        : first(mesh.positions.size(), none), last(mesh.positions.size(), none),
          next(mesh.triangles.size() * 3, none) {
        for (std::size_t t = mesh.triangles.size(); t-- > 0;)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const std::uint32_t v = mesh.triangles[t][c];
                if (v >= first.size()) throw std::runtime_error("a triangle has a corner that is no vertex");
                const auto corner = std::uint32_t(3 * t + c);
                next[corner] = first[v], first[v] = corner;
                if (last[v] == none) last[v] = corner;
            }
    }

    template <class Do> void each_at(std::uint32_t vertex, Do&& act) const {
        for (std::uint32_t c = first[vertex]; c != none; c = next[c]) act(c / 3, c % 3);
    }

    void merge(std::uint32_t into, std::uint32_t from) {
        if (first[from] == none) return;
        (first[into] == none ? first[into] : next[last[into]]) = first[from];
        last[into] = last[from];
        first[from] = last[from] = none;
    }

  private:
    std::vector<std::uint32_t> first, last, next;
};

/// What stands at each place of `order`, in that order.
template <class T> void reorder(std::vector<T>& all, const std::vector<std::uint32_t>& order) {
    if (all.empty()) return;
    std::vector<T> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t k : order) sorted.push_back(all[k]);
    all.swap(sorted);
}

/// Where each key ended up: the inverse of an order.
std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = std::uint32_t(k);
    return place;
}

} // namespace

ProgressiveMesh::ProgressiveMesh(const Mesh& mesh, std::span<const Collapse> log) : now(mesh) {
    if (3 * mesh.triangles.size() >= none || mesh.positions.size() >= none)
        throw std::runtime_error("a mesh of more than 1,431,655,764 triangles has no progressive mesh");
    // Which split brings each, none for what is in the base: indices of the original until all collapses are
    // made.
    std::vector<std::uint32_t> vertex_split(mesh.positions.size(), none),
        triangle_split(mesh.triangles.size(), none);
    collapse_all(log, vertex_split, triangle_split);
    number_by_split(vertex_split, triangle_split);
    count_base_edges();
}

void ProgressiveMesh::collapse_all(std::span<const Collapse> log, std::vector<std::uint32_t>& vertex_split,
                                   std::vector<std::uint32_t>& triangle_split) {
    kept.resize(log.size()), moved_end.resize(log.size()), triangle_end.assign(log.size(), 0);
    other_positions.resize(log.size());
    other_colours.resize(has_colours() ? log.size() : 0),
        other_normals.resize(has_normals() ? log.size() : 0);
    Corners corners(now);
    for (std::size_t k = 0; k < log.size(); ++k) {
        const Collapse& c = log[k];
        const std::size_t split = log.size() - 1 - k, before = moved.size();
        const auto is_left = [&](std::uint32_t v) {
            return v < vertex_split.size() && vertex_split[v] == none;
        };
        if (!is_left(c.kept) || !is_left(c.removed) || c.kept == c.removed)
            refuse("collapse " + std::to_string(k) + " names a vertex that is not there");
        corners.each_at(c.removed, [&](std::uint32_t t, std::uint32_t corner) {
            if (triangle_split[t] != none) return;
            Triangle& triangle = now.triangles[t];
            if (std::find(triangle.begin(), triangle.end(), c.kept) != triangle.end())
                triangle_split[t] = std::uint32_t(split), ++triangle_end[split];
            else
                triangle[corner] = c.kept, moved.push_back(t);
        });
        if (triangle_end[split] < 1 || triangle_end[split] > 2)
            refuse("collapse " + std::to_string(k) + " is of no edge of a two-manifold");
        corners.merge(c.kept, c.removed);
        vertex_split[c.removed] = std::uint32_t(split);
        kept[split] = c.kept, moved_end[split] = std::uint32_t(moved.size() - before);
        other_positions[split] = std::exchange(now.positions[c.kept], c.position);
        if (has_colours()) other_colours[split] = std::exchange(now.colours[c.kept], c.colour);
        if (has_normals()) other_normals[split] = std::exchange(now.normals[c.kept], c.normal);
    }
}

void ProgressiveMesh::number_by_split(std::vector<std::uint32_t>& vertex_split,
                                      std::vector<std::uint32_t>& triangle_split) {
    for (std::uint32_t& split : vertex_split) ++split; // the base, none, becomes 0 and comes first
    for (std::uint32_t& split : triangle_split) ++split;
    base_vertices = vertex_split.size() - splits();
    base_triangles = std::size_t(std::count(triangle_split.begin(), triangle_split.end(), 0u));
    vertex_ids = progressive::order_of(vertex_split), triangle_ids = progressive::order_of(triangle_split);
    const std::vector<std::uint32_t> vertex_number = inverse(vertex_ids),
                                     triangle_number = inverse(triangle_ids);

    reorder(now.positions, vertex_ids), reorder(now.colours, vertex_ids), reorder(now.normals, vertex_ids);
    reorder(now.triangles, triangle_ids);
    for (Triangle& t : now.triangles)
        for (std::uint32_t& corner : t) corner = vertex_number[corner];
    for (std::uint32_t& vertex : kept) vertex = vertex_number[vertex];
    std::reverse(moved.begin(), moved.end()); // the last collapse is the first split
    for (std::uint32_t& triangle : moved) triangle = triangle_number[triangle];
    moved.shrink_to_fit();
    std::size_t triangles_so_far = base_triangles, moved_so_far = 0; // from here on counts become ends
    for (std::size_t k = 0; k < splits(); ++k) {
        triangle_end[k] = std::uint32_t(triangles_so_far += triangle_end[k]);
        const auto first = moved.begin() + std::ptrdiff_t(moved_so_far);
        moved_end[k] = std::uint32_t(moved_so_far += moved_end[k]);
        std::sort(first, moved.begin() + std::ptrdiff_t(moved_so_far));
    }
}

} // namespace glcast
