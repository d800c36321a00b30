#include "tools/simplify/round.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace glcast {
namespace {

// The first round collapses what costs up to so many times the median: that leaves about a third of the
// triangles.
constexpr float first_price = 30;
constexpr std::size_t tiles_asked_for_price = 8;

/// Names of a tile's vertices: first those that are its own, then those on its rim.
class Naming {
  public:
    Naming(const Tiles& tiles, std::uint32_t tile, std::span<const Triangle> triangles,
           std::vector<std::uint32_t>& local)
        : tiles(tiles), tile(tile), local(local) {
        for (const std::uint32_t t : tiles.triangles(tile))
            for (const std::uint32_t v : triangles[t])
                if (!owns(v)) rim.push_back(v);
        std::sort(rim.begin(), rim.end());
        rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
        for (const std::uint32_t t : tiles.triangles(tile))
            for (const std::uint32_t v : triangles[t])
                if (owns(v) && (local[v] >= own.size() || own[local[v]] != v)) {
                    local[v] = std::uint32_t(own.size());
                    own.push_back(v);
                }
    }

    bool owns(std::uint32_t v) const { return v < tiles.owner.size() && tiles.owner[v] == tile; }
    std::uint32_t operator()(std::uint32_t v) const {
        if (owns(v)) return local[v];
        return std::uint32_t(own.size()) +
               std::uint32_t(std::lower_bound(rim.begin(), rim.end(), v) - rim.begin());
    }
    std::size_t owned() const { return own.size(); }
    std::vector<std::uint32_t> names() && {
        own.insert(own.end(), rim.begin(), rim.end());
        return std::move(own);
    }

  private:
    const Tiles& tiles;
    std::uint32_t tile;
    std::vector<std::uint32_t>& local; ///< by vertex of the surface: each tile writes at its own ones
    std::vector<std::uint32_t> own, rim;
};

template <int N>
void fill_vertices(NamedPatch<N>& into, const Surface<N>& surface, const Mesh& mesh, const UnitCube& cube) {
    const std::size_t count = into.names.size();
    Patch<N>& patch = into.patch;
    patch.position.resize(count), patch.source_at.resize(count), patch.source.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t v = into.names[i];
        if (v == surface.ghost()) {
            patch.ghost = std::uint32_t(i);
            continue;
        }
        patch.position[i] = surface.position[v];
        patch.source[i] = surface.source[v];
        patch.source_at[i] =
            surface.moved[v] ? cube.inside(mesh.positions[surface.source[v]]) : surface.position[v];
    }
}

template <int N> struct Workplace {
    const Surface<N>& surface;
    const Mesh& mesh;
    const UnitCube& cube;
    const TriangleQuadrics<N>& of_triangles;
    const Tiles& tiles;
    std::vector<std::uint32_t>& local;

    NamedPatch<N> patch_of(std::uint32_t tile) const {
        Naming naming(tiles, tile, surface.triangles, local);
        NamedPatch<N> made;
        std::vector<std::uint32_t> corners;
        corners.reserve(tiles.triangles(tile).size() * 3);
        for (const std::uint32_t t : tiles.triangles(tile))
            for (const std::uint32_t v : surface.triangles[t]) corners.push_back(naming(v));
        const std::size_t owned = naming.owned();
        made.patch.quadrics.resize(owned);
        if (surface.quadrics.empty())
            for (const std::uint32_t t : tiles.triangles(tile))
                of_triangles.add(t, [&](std::uint32_t v) {
                    return naming.owns(v) ? &made.patch.quadrics[local[v]] : nullptr;
                });
        made.names = std::move(naming).names();
        if (!surface.quadrics.empty())
            for (std::size_t i = 0; i < owned; ++i) made.patch.quadrics[i] = surface.quadrics[made.names[i]];
        fill_vertices(made, surface, mesh, cube);
        made.patch.locked.assign(made.names.size(), 1);
        std::fill_n(made.patch.locked.begin(), owned, 0);
        made.patch.connect(std::move(corners));
        return made;
    }
};

template <int N> float find_price(const Workplace<N>& workplace) {
    std::vector<float> costs;
    const std::size_t tiles = workplace.tiles.count(), asked = std::min(tiles, tiles_asked_for_price);
    for (std::size_t k = 0; k < asked; ++k) {
        const std::vector<float> more = workplace.patch_of(std::uint32_t(k * tiles / asked)).patch.costs();
        costs.insert(costs.end(), more.begin(), more.end());
    }
    if (costs.empty()) return 0;
    std::nth_element(costs.begin(), costs.begin() + std::ptrdiff_t(costs.size() / 2), costs.end());
    return first_price * costs[costs.size() / 2];
}

template <int N> struct TileResult {
    std::vector<Step> steps;
    std::vector<std::pair<std::uint32_t, Quadric<N>>>
        quadrics; ///< of the vertices that are left; on the rim: changes
};

template <int N> TileResult<N> collapse_tile(NamedPatch<N>&& made, const RoundOptions& options) {
    TileResult<N> result;
    made.patch.memoryless = made.patch.in_exact_order = !options.thins;
    made.patch.queue_edges(options.price);
    std::vector<char> gone(made.names.size(), 0);
    float dearest = 0; // so far: none comes before those that the tile made earlier
    for (Step step; made.patch.collapse_cheapest(step);) {
        step.cost = dearest = std::max(dearest, step.cost);
        gone[step.removed] = 1;
        step.kept = made.names[step.kept];
        step.removed = made.names[step.removed];
        result.steps.push_back(step);
    }
    for (std::size_t i = 0; !options.thins && i < made.patch.quadrics.size(); ++i)
        if (!gone[i] && i != made.patch.ghost)
            result.quadrics.emplace_back(made.names[i], made.patch.quadrics[i]);
    return result;
}

template <int N> std::vector<Step> all_steps(std::vector<TileResult<N>>& results) {
    std::vector<std::size_t> first(results.size() + 1, 0);
    for (std::size_t tile = 0; tile < results.size(); ++tile)
        first[tile + 1] = first[tile] + results[tile].steps.size();
    std::vector<Step> steps(first.back());
    tbb::parallel_for(std::size_t(0), results.size(), [&](std::size_t tile) {
        std::copy(results[tile].steps.begin(), results[tile].steps.end(),
                  steps.begin() + std::ptrdiff_t(first[tile]));
        results[tile].steps = {};
    });
    return steps;
}

/// The quadrics of what is left: from the tiles; on the rims, what they were and what the tiles changed.
template <int N>
void gather_quadrics(Surface<N>& left, const std::vector<std::uint32_t>& became, const Workplace<N>& from,
                     const std::vector<TileResult<N>>& results) {
    left.quadrics.resize(left.position.size());
    const auto at_rim = [&](std::uint32_t v) { return from.tiles.owner[v] == Tiles::shared; };
    if (from.surface.quadrics.empty()) {
        for (std::size_t t = 0; t < from.surface.triangles.size(); ++t)
            from.of_triangles.add(
                t, [&](std::uint32_t v) { return at_rim(v) ? &left.quadrics[became[v]] : nullptr; });
    } else {
        for (std::uint32_t v = 0; v < from.surface.ghost(); ++v)
            if (at_rim(v)) left.quadrics[became[v]] = from.surface.quadrics[v];
    }
    tbb::parallel_for(std::size_t(0), results.size(), [&](std::size_t tile) {
        for (const auto& [v, quadric] : results[tile].quadrics)
            if (!at_rim(v)) left.quadrics[became[v]] = quadric;
    });
    for (const TileResult<N>& result : results) // a rim lies in several: in one order
        for (const auto& [v, quadric] : result.quadrics)
            if (at_rim(v)) left.quadrics[became[v]] += quadric;
}

} // namespace

std::vector<Step> by_cost(const std::vector<Step>& steps) {
    std::vector<std::pair<float, std::uint32_t>> keys(steps.size());
    tbb::parallel_for(std::size_t(0), steps.size(), [&](std::size_t k) {
        keys[k] = {steps[k].cost, std::uint32_t(k)};
    });
    tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<Step> ordered(steps.size());
    tbb::parallel_for(std::size_t(0), keys.size(),
                      [&](std::size_t k) { ordered[k] = steps[keys[k].second]; });
    return ordered;
}

template <int N>
NamedPatch<N> whole_patch(const Surface<N>& surface, const Mesh& mesh, const UnitCube& cube,
                          const TriangleQuadrics<N>& of_triangles) {
    NamedPatch<N> made;
    made.names.resize(surface.position.size() + 1);
    std::iota(made.names.begin(), made.names.end(), 0);
    made.patch.quadrics = surface.quadrics;
    if (surface.quadrics.empty()) {
        made.patch.quadrics.resize(surface.position.size());
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
            of_triangles.add(t, [&](std::uint32_t v) { return &made.patch.quadrics[v]; });
    }
    fill_vertices(made, surface, mesh, cube);
    made.patch.locked.assign(made.names.size(), 0);
    made.patch.locked.back() = 1;
    std::vector<std::uint32_t> corners;
    corners.reserve(surface.triangles.size() * 3);
    for (const Triangle& t : surface.triangles) corners.insert(corners.end(), t.begin(), t.end());
    made.patch.connect(std::move(corners));
    return made;
}

template <int N>
Round<N> collapse_tiles(const Surface<N>& surface, const Mesh& mesh, const UnitCube& cube,
                        const TriangleQuadrics<N>& of_triangles, RoundOptions& options) {
    const Tiles tiles =
        cut_into_tiles(surface.position, surface.triangles, options.triangles_per_tile, options.turn);
    std::vector<std::uint32_t> local(surface.position.size());
    const Workplace<N> workplace{surface, mesh, cube, of_triangles, tiles, local};
    if (!(options.price > 0)) options.price = find_price(workplace);
    std::vector<TileResult<N>> results(tiles.count());
    tbb::parallel_for(
        std::size_t(0), tiles.count(),
        [&](std::size_t tile) {
            results[tile] = collapse_tile(workplace.patch_of(std::uint32_t(tile)), options);
        },
        tbb::simple_partitioner());
    Round<N> round;
    round.steps = all_steps(results);
    static_cast<Shape&>(round.left) = after_steps(surface, round.steps, round.became);
    if (!options.thins) gather_quadrics(round.left, round.became, workplace, results);
    return round;
}

#define GLCAST_INSTANTIATE(N)                                                                                \
    template NamedPatch<N> whole_patch(const Surface<N>&, const Mesh&, const UnitCube&,                      \
                                       const TriangleQuadrics<N>&);                                          \
    template Round<N> collapse_tiles(const Surface<N>&, const Mesh&, const UnitCube&,                        \
                                     const TriangleQuadrics<N>&, RoundOptions&);
GLCAST_INSTANTIATE(0)
GLCAST_INSTANTIATE(3)
GLCAST_INSTANTIATE(6)

} // namespace glcast
