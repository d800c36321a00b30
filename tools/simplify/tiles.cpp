#include "tools/simplify/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "tools/mesh/morton.h"

namespace glcast {
namespace {

constexpr unsigned bits = 6; // of a coordinate: 64 cells a side, in the order of Morton's curve
constexpr std::uint32_t cells = 1U << (3 * bits);
// Of the triangles, that are sorted at the same time.
constexpr std::size_t triangles_a_part = 500'000, most_parts = 8;

/// The cube takes up half the curve's, at another place every turn.
std::uint32_t cell_of(const glm::dvec3& p, const glm::dvec3& shift) {
    static const auto table = [] {
        std::array<std::uint32_t, 1U << bits> all{};
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = spread_bits(i);
        return all;
    }();
    const auto at = [](double x) { return std::size_t(std::clamp(x, 0.0, 0.999999) * (1U << bits)); };
    return table[at((p.x + 0.5 + shift.x) / 2)] | table[at((p.y + 0.5 + shift.y) / 2)] << 1 |
           table[at((p.z + 0.5 + shift.z) / 2)] << 2;
}

/// In each cell in their order.
void sort_by_cell(const std::vector<std::uint32_t>& cell, std::size_t triangles_per_tile, Tiles& tiles) {
    const std::size_t parts = std::clamp<std::size_t>(cell.size() / triangles_a_part, 1, most_parts);
    const auto begin_of = [&](std::size_t part) { return cell.size() * part / parts; };
    std::vector<std::uint32_t> begins(cells * parts, 0); // by cell, and part of the triangles
    tbb::parallel_for(std::size_t(0), parts, [&](std::size_t part) {
        for (std::size_t t = begin_of(part); t < begin_of(part + 1); ++t) ++begins[cell[t] * parts + part];
    });
    std::uint32_t before = 0;
    tiles.first.push_back(0);
    for (std::size_t c = 0; c < cells; ++c) {
        for (std::size_t k = c * parts; k < (c + 1) * parts; ++k) before += std::exchange(begins[k], before);
        if (before - tiles.first.back() >= triangles_per_tile) tiles.first.push_back(before);
    }
    if (tiles.first.back() != cell.size()) {
        if (tiles.first.size() > 1) tiles.first.pop_back(); // the rest goes to the last one
        tiles.first.push_back(std::uint32_t(cell.size()));
    }
    tiles.order.resize(cell.size());
    tbb::parallel_for(std::size_t(0), parts, [&](std::size_t part) {
        for (std::size_t t = begin_of(part); t < begin_of(part + 1); ++t)
            tiles.order[begins[cell[t] * parts + part]++] = std::uint32_t(t);
    });
}

/// Whichever tile comes first to a vertex: in the end it is the only one's, or shared.
void find_owners(std::span<const Triangle> triangles, std::size_t vertices, Tiles& tiles) {
    constexpr std::uint32_t nobody = Tiles::shared - 1;
    tiles.owner.assign(vertices, nobody);
    tbb::parallel_for(std::size_t(0), tiles.count(), [&](std::size_t k) {
        const auto tile = std::uint32_t(k);
        for (const std::uint32_t t : tiles.triangles(tile))
            for (const std::uint32_t v : triangles[t]) {
                if (v >= vertices) continue;
                const std::atomic_ref<std::uint32_t> owner(tiles.owner[v]);
                std::uint32_t was = owner.load(std::memory_order_relaxed);
                if (was == nobody) owner.compare_exchange_strong(was, tile, std::memory_order_relaxed);
                if (was != nobody && was != tile) owner.store(Tiles::shared, std::memory_order_relaxed);
            }
    });
}

} // namespace

Tiles cut_into_tiles(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                     std::size_t triangles_per_tile, unsigned turn) {
    // Roberts's sequence for three dimensions.
    const glm::dvec3 shift(std::fmod(0.5 + 0.8191725 * turn, 1.0), std::fmod(0.5 + 0.6710436 * turn, 1.0),
                           std::fmod(0.5 + 0.5497004 * turn, 1.0));
    std::vector<std::uint32_t> cell(triangles.size());
    tbb::parallel_for(std::size_t(0), triangles.size(), [&](std::size_t t) {
        const Triangle& corners = triangles[t];
        const auto last = std::find_if(corners.rbegin(), corners.rend(),
                                       [&](std::uint32_t v) { return v < positions.size(); });
        if (last != corners.rend()) cell[t] = cell_of(positions[*last], shift);
    });
    Tiles tiles;
    sort_by_cell(cell, triangles_per_tile, tiles);
    find_owners(triangles, positions.size(), tiles);
    return tiles;
}

} // namespace glcast
