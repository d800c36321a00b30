// Why it is enough to look at the suspects, and why it ends.
//
// Two quads that are no suspects do not meet. Their corners are in their cells, and these cells have one
// patch each, so one arc crosses each of their faces and all quads at a face use the same mesh edge, which
// crosses the face in one point f (two cells with a common face are convex together). The triangles (lattice
// edge, f) part a face, so the cones over them from the cell's vertex part the cell; the envelope of a quad
// is the four pairs of cones about its lattice edge, and envelopes share nothing but their sides (Ju and
// Udeshi 2006). A quad within its envelope, clear of its sides, therefore meets no other but where they are
// joined. `in_envelope` in quads.cpp tests just that.
//
// A suspect may meet anything: it is tested exactly. The vertices of triangles that meet go a rung down the
// ladder of vertex_on_rung(), all at once, and whatever touches them is tested again. The last rung of all is
// the surface of the cubes with the patches of a cell pulled apart: a face of a cube meets another in a
// common edge or corner only, and there the patches are apart because their offsets d differ in a direction
// that keeps the quarter planes p + d_p and q + d_q of any two of their quads apart
// (tests/reconstruct/tables_test.cpp goes through all configurations; across an ambiguous face they differ
// strictly in both directions, so the mesh edges between two cells stay apart too). So two triangles that
// meet have a vertex that is not on the last rung: each round moves one at least, and the rounds end.
#include "tools/reconstruct/mend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>
#include <tbb/parallel_for.h>
#include <unordered_map>

#include "tools/mesh/intersections.h"
#include "tools/reconstruct/frame.h"
#include "tools/reconstruct/quads.h"
#include "tools/reconstruct/vertices.h"

namespace glcast {
namespace {

using Numbers = std::vector<std::uint32_t>; ///< sorted, each once
using Rows = std::vector<std::uint8_t>;     ///< by CellGrid::row

void sort_once(Numbers& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Blocks of samples, 256 along an axis at most: a bit each.
class Blocks {
  public:
    explicit Blocks(int n) {
        while ((n + 8) >> shift > 256) ++shift;
        side = ((n + 8) >> shift) + 1;
        bits.resize(std::size_t(side) * side * side);
    }
    void mark(const glm::dvec3& lo, const glm::dvec3& hi) {
        over(lo, hi, [&](std::size_t at) {
            bits[at] = true;
            return false;
        });
    }
    bool any(const glm::dvec3& lo, const glm::dvec3& hi) const {
        return over(lo, hi, [&](std::size_t at) { return bool(bits[at]); });
    }

  private:
    template <class Each> bool over(const glm::dvec3& lo, const glm::dvec3& hi, Each each) const {
        int from[3], to[3];
        for (int k = 0; k < 3; ++k) {
            from[k] = std::clamp(int(std::floor(lo[k])) + 4, 0, (side << shift) - 1) >> shift;
            to[k] = std::clamp(int(std::floor(hi[k])) + 4, 0, (side << shift) - 1) >> shift;
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x)
                    if (each((std::size_t(z) * side + y) * side + x)) return true;
        return false;
    }
    int shift = 2, side;
    std::vector<std::uint8_t> bits;
};

class Mender {
  public:
    Mender(const Rays& rays, const CellGrid& grid, const QuadReport& quads,
           std::span<const Triangle> triangles, const CaptureFrame& frame, std::vector<glm::dvec3>& positions)
        : rays(rays), grid(grid), quads(quads), triangles(triangles), frame(frame), positions(positions),
          stray(quads.stray) {}

    MendReport run() {
        MendReport report;
        Numbers probes;
        for (std::uint32_t quad : quads.suspects) probes.insert(probes.end(), {2 * quad, 2 * quad + 1});
        report.suspects = quads.suspects.size();
        while (!probes.empty()) {
            const std::vector<TrianglePair> pairs = pairs_of(probes);
            if (report.rounds == 0) report.intersections = pairs.size();
            if (pairs.empty()) break;
            ++report.rounds;
            probes = touching(move(pairs));
        }
        for (const auto& [vertex, at] : rung) ++report.moved[at];
        return report;
    }

  private:
    template <class Keep> Numbers pick(const Rows& rows, Keep keep) const;
    void mark(Rows& rows, const glm::dvec3& lo, const glm::dvec3& hi) const;
    std::vector<TrianglePair> pairs_of(const Numbers& probes) const;
    Numbers move(const std::vector<TrianglePair>& pairs);
    Numbers touching(const Numbers& vertices);
    std::pair<glm::dvec3, glm::dvec3> bounds(std::uint32_t t) const {
        const glm::dvec3 &a = positions[triangles[t][0]], &b = positions[triangles[t][1]],
                         &c = positions[triangles[t][2]];
        // frame() rounds
        return {glm::min(glm::min(a, b), c) - 2e-2, glm::max(glm::max(a, b), c) + 2e-2};
    }

    const Rays& rays;
    const CellGrid& grid;
    const QuadReport& quads;
    std::span<const Triangle> triangles;
    const CaptureFrame& frame;
    std::vector<glm::dvec3>& positions;
    double stray;                                ///< QuadReport::stray; grows with what moves
    std::unordered_map<std::uint32_t, int> rung; ///< of vertices that moved
};

/// The triangles of the marked rows that pass keep(triangle).
template <class Keep> Numbers Mender::pick(const Rows& rows, Keep keep) const {
    std::vector<Numbers> of_layer(grid.n + 1);
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        for (int y = 0; y <= grid.n; ++y) {
            if (!rows[grid.row(y, z)]) continue;
            const std::uint32_t* first = &quads.first_quad[grid.row(y, z)];
            for (std::uint32_t t = 2 * first[0]; t < 2 * first[1]; ++t)
                if (keep(t)) of_layer[z].push_back(t);
        }
    });
    Numbers all;
    for (const Numbers& some : of_layer) all.insert(all.end(), some.begin(), some.end());
    return all;
}

/// Rows whose quads may reach into the box: row y has vertices in cells y - 1 and y, and cell y is between
/// samples y - 1 and y.
void Mender::mark(Rows& rows, const glm::dvec3& lo, const glm::dvec3& hi) const {
    int from[3], to[3];
    for (int k = 1; k < 3; ++k) {
        from[k] = std::max(0, int(std::floor(lo[k] - stray)));
        to[k] = std::min(grid.n, int(std::ceil(hi[k] + 2 + stray)));
    }
    for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y) rows[grid.row(y, z)] = true;
}

std::vector<TrianglePair> Mender::pairs_of(const Numbers& probes) const {
    Blocks blocks(grid.n);
    Rows rows(grid.row_start.size());
    for (std::uint32_t t : probes) {
        const auto [lo, hi] = bounds(t);
        blocks.mark(lo, hi);
        mark(rows, lo, hi);
    }
    const Numbers near = pick(rows, [&](std::uint32_t t) {
        const auto [lo, hi] = bounds(t);
        return blocks.any(lo, hi);
    });
    // Only what is near, with numbers of its own and as it will be written.
    Numbers number(positions.size(), 0), vertices, own_probes, own_all(near.size());
    for (std::uint32_t t : near)
        for (std::uint32_t v : triangles[t]) number[v] = 1;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (!number[v]) continue;
        number[v] = std::uint32_t(vertices.size());
        vertices.push_back(v);
    }
    std::vector<glm::dvec3> points(vertices.size());
    tbb::parallel_for(std::size_t(0), points.size(),
                      [&](std::size_t i) { points[i] = frame(positions[vertices[i]]); });
    std::vector<Triangle> faces(near.size());
    tbb::parallel_for(std::size_t(0), near.size(), [&](std::size_t i) {
        own_all[i] = std::uint32_t(i);
        for (int k = 0; k < 3; ++k) faces[i][k] = number[triangles[near[i]][k]];
    });
    for (std::uint32_t t : probes)
        own_probes.push_back(std::uint32_t(std::lower_bound(near.begin(), near.end(), t) - near.begin()));
    auto pairs = find_intersections_of(points, faces, own_probes, own_all);
    for (auto& [a, b] : pairs) a = near[a], b = near[b];
    return pairs;
}

/// The vertices of the pairs, each a rung further.
Numbers Mender::move(const std::vector<TrianglePair>& pairs) {
    Numbers vertices;
    for (const auto& [a, b] : pairs)
        for (std::uint32_t t : {a, b})
            vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
    sort_once(vertices);
    std::erase_if(vertices, [&](std::uint32_t v) { return rung[v] == last_rung; });
    if (vertices.empty()) throw std::logic_error("two triangles meet where none can");
    for (std::uint32_t v : vertices) ++rung[v];
    tbb::parallel_for(std::size_t(0), vertices.size(), [&](std::size_t i) {
        const std::uint32_t v = vertices[i];
        positions[v] = vertex_on_rung(rays, grid, v, rung.find(v)->second);
    });
    return vertices;
}

Numbers Mender::touching(const Numbers& vertices) {
    std::vector<bool> moved(positions.size());
    for (std::uint32_t v : vertices) moved[v] = true;
    Rows rows(grid.row_start.size());
    for (std::uint32_t v : vertices) { // the quads of a cell are owned by it and the next ones
        const PlacedCell at = find_cell(grid, v);
        for (int z = at.z; z <= std::min(at.z + 1, grid.n); ++z)
            for (int y = at.y; y <= std::min(at.y + 1, grid.n); ++y) rows[grid.row(y, z)] = true;
        const glm::dvec3 off = glm::abs(positions[v] - glm::dvec3(at.cell.x, at.y, at.z) + 0.5);
        stray = std::max({stray, off.x - 0.5, off.y - 0.5, off.z - 0.5});
    }
    return pick(rows, [&](std::uint32_t t) {
        return moved[triangles[t][0]] || moved[triangles[t][1]] || moved[triangles[t][2]];
    });
}

} // namespace

MendReport mend_intersections(const Rays& rays, const CellGrid& grid, const QuadReport& quads,
                              std::span<const Triangle> triangles, const CaptureFrame& frame,
                              std::vector<glm::dvec3>& positions) {
    return Mender(rays, grid, quads, triangles, frame, positions).run();
}

} // namespace glcast
