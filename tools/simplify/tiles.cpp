#include "tools/simplify/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace glcast {
namespace {

constexpr unsigned bits = 6; // of a coordinate: 64 cells a side, in the order of Morton's curve
constexpr std::uint32_t cells = 1U << (3 * bits);

std::uint32_t spread(std::uint32_t x) {
    std::uint32_t spread = 0;
    for (unsigned bit = 0; bit < bits; ++bit) spread |= (x >> bit & 1) << (3 * bit);
    return spread;
}

/// The cube takes up half the curve's, at another place every turn.
std::uint32_t cell_of(const glm::dvec3& p, const glm::dvec3& shift) {
    static const auto table = [] {
        std::array<std::uint32_t, 1U << bits> all{};
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = spread(i);
        return all;
    }();
    const auto at = [](double x) { return std::size_t(std::clamp(x, 0.0, 0.999999) * (1U << bits)); };
    return table[at((p.x + 0.5 + shift.x) / 2)] | table[at((p.y + 0.5 + shift.y) / 2)] << 1 |
           table[at((p.z + 0.5 + shift.z) / 2)] << 2;
}

} // namespace

Tiles cut_into_tiles(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                     std::size_t triangles_per_tile, unsigned turn) {
    // Roberts's sequence for three dimensions.
    const glm::dvec3 shift(std::fmod(0.5 + 0.8191725 * turn, 1.0), std::fmod(0.5 + 0.6710436 * turn, 1.0),
                           std::fmod(0.5 + 0.5497004 * turn, 1.0));
    std::vector<std::uint32_t> cell(triangles.size());
    tbb::parallel_for(std::size_t(0), triangles.size(), [&](std::size_t t) {
        for (const std::uint32_t v : triangles[t])
            if (v < positions.size()) cell[t] = cell_of(positions[v], shift);
    });
    std::vector<std::uint32_t> begins(cells + 1, 0);
    for (const std::uint32_t c : cell) ++begins[c + 1];
    for (std::uint32_t c = 0; c < cells; ++c) begins[c + 1] += begins[c];

    Tiles tiles;
    tiles.first.push_back(0);
    for (std::uint32_t c = 0; c < cells; ++c)
        if (begins[c + 1] - tiles.first.back() >= triangles_per_tile) tiles.first.push_back(begins[c + 1]);
    if (tiles.first.back() != triangles.size()) {
        if (tiles.first.size() > 1) tiles.first.pop_back(); // the rest goes to the last one
        tiles.first.push_back(std::uint32_t(triangles.size()));
    }
    tiles.order.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) tiles.order[begins[cell[t]]++] = t;

    constexpr std::uint32_t nobody = Tiles::shared - 1;
    tiles.owner.assign(positions.size(), nobody);
    for (std::uint32_t tile = 0; tile < tiles.count(); ++tile)
        for (const std::uint32_t t : tiles.triangles(tile))
            for (const std::uint32_t v : triangles[t])
                if (v < positions.size() && tiles.owner[v] != tile)
                    tiles.owner[v] = tiles.owner[v] == nobody ? tile : Tiles::shared;
    return tiles;
}

} // namespace glcast
