#include "tools/reconstruct/sides.h"

#include <cmath>

namespace glcast {
namespace {

constexpr float tolerance = 0.06f; // as for crossings: a hit so far beyond its edge still belongs to it

class Column {
  public:
    Column(const Rays& rays, int axis, int u, int v) : rays(rays), axis(axis), at{} {
        const ImageAxes image = image_axes(Axis(axis));
        at[image.u] = u;
        at[image.v] = v;
    }
    bool filled(int depth) {
        at[axis] = depth;
        return rays.filled(at);
    }
    std::uint32_t sides(float depth) {
        std::uint32_t found = 0;
        const int below = int(std::floor(depth));
        for (int low = below - 1; low <= below + 1; ++low) {
            const bool low_filled = filled(low);
            if (low_filled == filled(low + 1)) continue;
            // F is the filled end; of a sheet's own sample both neighbours are empty, and the sheet is near
            // it.
            const int f = low_filled ? low : low + 1, behind = low_filled ? low - 1 : low + 2;
            const bool own = depth >= float(low) - tolerance && depth <= float(low + 1) + tolerance;
            const bool sheet = std::abs(depth - float(f)) <= 1 && !filled(behind);
            if (own || sheet) found |= low_filled ? seen_from_plus : seen_from_minus;
        }
        return found;
    }

  private:
    const Rays& rays;
    int axis;
    std::array<int, 3> at;
};

} // namespace

void mark_sides(Rays& rays) {
    const int n = rays.n;
    for (int axis = 0; axis < 3; ++axis)
        tbb::parallel_for(0, n, [&](int v) {
            AxisHits& hits = rays.axis[axis];
            for (int u = 0; u < n; ++u) {
                const std::size_t pixel = std::size_t(v) * n + u;
                Column column(rays, axis, u, v);
                for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i)
                    hits.colour[i] |= column.sides(hits.depth[i]);
            }
        });
}

} // namespace glcast
