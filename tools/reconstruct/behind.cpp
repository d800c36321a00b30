#include "tools/reconstruct/behind.h"

#include <cmath>
#include <optional>

namespace glcast {
namespace {

constexpr float tolerance = 0.06f; // as for crossings: a hit so far beyond its edge still belongs to it

/// The samples of one ray, counted from `first` outward.
class Column {
  public:
    Column(const Rays& rays, int axis, int outward, const std::array<int, 3>& first)
        : rays(rays), axis(axis), outward(outward), first(first) {}

    bool filled(int step) const {
        std::array<int, 3> sample = first;
        sample[axis] += step * outward;
        return rays.filled(sample);
    }
    float steps(float depth) const { return (depth - float(first[axis])) * float(outward); }

    /// The filled sample nearest to the first one with none outward of it.
    std::optional<int> outermost_filled(int reach) const {
        for (int away = 0; away <= reach; ++away)
            for (const int step : {-away, away})
                if (filled(step) && !filled(step + 1)) return step;
        return std::nullopt;
    }

  private:
    const Rays& rays;
    const int axis, outward;
    const std::array<int, 3> first;
};

} // namespace

int main_axis(const glm::vec3& v) {
    int axis = 0;
    for (const int k : {1, 2})
        if (std::abs(v[k]) > std::abs(v[axis])) axis = k;
    return axis;
}

HitBehind hit_behind_closing(const Rays& rays, const glm::dvec3& at, const glm::vec3& facing, int axis,
                             double reach) {
    if (!rays.complete) return {};
    const std::array<int, 3> sample = {int(std::lround(at.x)), int(std::lround(at.y)),
                                       int(std::lround(at.z))};
    if (!rays.inside(sample)) return {};
    HitBehind found{axis, no_hit, 0};
    const Column column(rays, found.axis, facing[found.axis] > 0 ? 1 : -1, sample);
    const std::optional<int> last = column.outermost_filled(int(reach));
    if (!last) return {};
    found.away = std::abs(double(column.steps(float(at[axis]))) - (*last + 0.5));
    // A sheet has a sample of its own, and lies up to one from it.
    const float drawn_from = float(*last) - (column.filled(*last - 1) ? tolerance : 1),
                drawn_to = float(*last + 1) + tolerance;
    const AxisHits& hits = rays.axis[found.axis];
    const std::size_t pixel = rays.pixel(found.axis, sample);
    float nearest = no_depth;
    for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i) {
        const float step = column.steps(hits.depth[i]);
        if (step >= drawn_from && step <= drawn_to) return {};
        if (step < drawn_from && drawn_from - step < nearest) nearest = drawn_from - step, found.hit = i;
    }
    return found;
}

} // namespace glcast
