#include "tools/progressive/progressive_mesh.h"

#include <algorithm>
#include <stdexcept>

#include "tools/progressive/order.h"

namespace glcast {
namespace {

template <class T> std::size_t bytes_of(const std::vector<T>& v) { return v.capacity() * sizeof(T); }

void replace(Triangle& triangle, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t& corner : triangle)
        if (corner == from) {
            corner = to;
            return;
        }
}

/// The last level for which `size(level)` is at most `most`; sizes grow with the level.
template <class Size> std::size_t last_within(std::size_t levels, std::size_t most, Size&& size) {
    std::size_t good = 0, bad = levels + 1;
    while (bad - good > 1) {
        const std::size_t middle = good + (bad - good) / 2;
        (size(middle) <= most ? good : bad) = middle;
    }
    return good;
}

} // namespace

ProgressiveMesh::ProgressiveMesh(Mesh base, std::vector<std::uint32_t> vertices,
                                 std::vector<std::uint32_t> triangles)
    : now(std::move(base)), vertex_ids(std::move(vertices)), triangle_ids(std::move(triangles)) {
    base_vertices = now.positions.size(), base_triangles = now.triangles.size();
    count_base_edges();
}

void ProgressiveMesh::count_base_edges() {
    std::vector<std::uint64_t> all;
    all.reserve(3 * base_triangles);
    for (std::size_t t = 0; t < base_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(now.triangles[t][k], now.triangles[t][(k + 1) % 3]);
            all.push_back(std::uint64_t(low) << 32 | high);
        }
    std::sort(all.begin(), all.end());
    base_edges = std::size_t(std::unique(all.begin(), all.end()) - all.begin());
}

void ProgressiveMesh::append(const Split& split) {
    if (at != splits())
        throw std::logic_error("a split is appended to a progressive mesh that is not fully refined");
    kept.push_back(split.kept);
    moved.insert(moved.end(), split.moved.begin(), split.moved.end());
    moved_end.push_back(std::uint32_t(moved.size()));
    vertex_ids.push_back(split.vertex_id);
    now.positions.push_back(split.added.position), other_positions.push_back(split.kept_fine.position);
    if (has_colours())
        now.colours.push_back(split.added.colour), other_colours.push_back(split.kept_fine.colour);
    if (has_normals())
        now.normals.push_back(split.added.normal), other_normals.push_back(split.kept_fine.normal);
    now.triangles.insert(now.triangles.end(), split.triangles.begin(), split.triangles.end());
    triangle_ids.insert(triangle_ids.end(), split.triangle_ids.begin(), split.triangle_ids.end());
    triangle_end.push_back(std::uint32_t(now.triangles.size()));
    forward();
}

void ProgressiveMesh::refine_to(std::size_t level) {
    if (level > splits()) throw std::logic_error("a progressive mesh is refined beyond its last level");
    while (at < level) forward();
    while (at > level) back();
}

void ProgressiveMesh::forward() {
    const auto added = std::uint32_t(base_vertices + at);
    for (const std::uint32_t t : moved_by(at)) replace(now.triangles[t], kept[at], added);
    swap_kept();
    ++at;
}

void ProgressiveMesh::back() {
    --at;
    const auto added = std::uint32_t(base_vertices + at);
    for (const std::uint32_t t : moved_by(at)) replace(now.triangles[t], added, kept[at]);
    swap_kept();
}

void ProgressiveMesh::swap_kept() {
    std::swap(now.positions[kept[at]], other_positions[at]);
    if (has_colours()) std::swap(now.colours[kept[at]], other_colours[at]);
    if (has_normals()) std::swap(now.normals[kept[at]], other_normals[at]);
}

std::span<const std::uint32_t> ProgressiveMesh::moved_by(std::size_t split) const {
    const std::size_t first = split ? moved_end[split - 1] : 0;
    return {moved.data() + first, moved_end[split] - first};
}

std::size_t ProgressiveMesh::edges(std::size_t level) const {
    return base_edges + level + (triangles(level) - base_triangles);
}

std::size_t ProgressiveMesh::level_of_vertices(std::size_t most) const {
    return last_within(splits(), most, [this](std::size_t level) { return vertices(level); });
}

std::size_t ProgressiveMesh::level_of_edges(std::size_t most) const {
    return last_within(splits(), most, [this](std::size_t level) { return edges(level); });
}

std::size_t ProgressiveMesh::level_of_triangles(std::size_t most) const {
    return last_within(splits(), most, [this](std::size_t level) { return triangles(level); });
}

ProgressiveMesh::Vertex ProgressiveMesh::vertex(std::uint32_t number) const {
    return {now.positions[number], has_colours() ? now.colours[number] : glm::vec3(0),
            has_normals() ? now.normals[number] : glm::vec3(0)};
}

ProgressiveMesh::Vertex ProgressiveMesh::other_of(std::size_t split) const {
    return {other_positions[split], has_colours() ? other_colours[split] : glm::vec3(0),
            has_normals() ? other_normals[split] : glm::vec3(0)};
}

std::vector<std::uint32_t> ProgressiveMesh::vertex_order() const {
    return progressive::order_of({vertex_ids.data(), vertices(at)});
}

Mesh ProgressiveMesh::mesh() const {
    const std::vector<std::uint32_t> order = vertex_order();
    std::vector<std::uint32_t> index(order.size());
    Mesh mesh;
    const auto take = [&](auto& to, const auto& from) {
        if (from.empty()) return;
        to.resize(order.size());
        for (std::size_t v = 0; v < order.size(); ++v) to[v] = from[order[v]];
    };
    take(mesh.positions, now.positions);
    take(mesh.colours, now.colours);
    take(mesh.normals, now.normals);
    for (std::size_t v = 0; v < order.size(); ++v) index[order[v]] = std::uint32_t(v);
    mesh.triangles.reserve(triangles(at));
    for (const std::uint32_t t : progressive::order_of({triangle_ids.data(), triangles(at)})) {
        const Triangle& corners = now.triangles[t];
        mesh.triangles.push_back({index[corners[0]], index[corners[1]], index[corners[2]]});
    }
    return mesh;
}

void ProgressiveMesh::shrink() {
    const auto each = [](auto&... vectors) { (vectors.shrink_to_fit(), ...); };
    each(now.positions, now.colours, now.normals, now.triangles, vertex_ids, triangle_ids, kept, triangle_end,
         moved_end, moved, other_positions, other_colours, other_normals);
}

std::size_t ProgressiveMesh::bytes() const {
    return bytes_of(now.positions) + bytes_of(now.colours) + bytes_of(now.normals) + bytes_of(now.triangles) +
           bytes_of(vertex_ids) + bytes_of(triangle_ids) + bytes_of(kept) + bytes_of(triangle_end) +
           bytes_of(moved_end) + bytes_of(moved) + bytes_of(other_positions) + bytes_of(other_colours) +
           bytes_of(other_normals);
}

} // namespace glcast
