// Steps from sample to sample through free space, for sets too sparse to be worth a sweep of the volume.
#pragma once
#include <cmath>
#include <unordered_map>

#include "tools/reconstruct/walls.h"

namespace glcast {

using SampleId = std::uint64_t; ///< (z * n + y) * n + x

inline SampleId id_of(const std::array<int, 3>& s, int n) {
    return (SampleId(s[2]) * n + s[1]) * n + s[0];
}
inline std::array<int, 3> sample_of(SampleId id, int n) {
    return {int(id % n), int(id / n % n), int(id / n / n)};
}

/// Does a surface cross the edge from s to the next sample along the axis?
inline bool has_wall(const Rays& rays, std::array<int, 3> s, int axis) {
    const AxisHits& hits = rays.axis[axis];
    const std::size_t p = rays.pixel(axis, s);
    const float low = float(s[axis]) - on_sample, high = float(s[axis] + 1) + on_sample;
    for (std::uint32_t i = hits.start[p]; i < hits.start[p + 1] && hits.depth[i] < high; ++i)
        if (hits.depth[i] >= low) return true;
    return false;
}

/// Calls visit(neighbour) for the samples in the box one step from s with no wall between.
template <class Visit> void for_steps(const Rays& rays, const std::array<int, 3>& s, Visit visit) {
    for (int axis = 0; axis < 3; ++axis)
        for (int side : {-1, 1}) {
            std::array<int, 3> next = s, low = s;
            next[axis] += side;
            if (!rays.inside(next)) continue;
            if (side < 0) low = next;
            if (!has_wall(rays, low, axis)) visit(next);
        }
}

/// Steps from a set, breadth first; `first` are the samples at level `level`. Goes on to samples that allowed(s)
/// and up to `most`. Returns the level of each.
template <class Allowed>
std::unordered_map<SampleId, int> flood(const Rays& rays, std::vector<SampleId> first, int level, int most,
                                        Allowed allowed) {
    std::unordered_map<SampleId, int> found;
    for (SampleId id : first) found.emplace(id, level);
    while (!first.empty() && level < most) {
        std::vector<SampleId> next;
        ++level;
        for (SampleId id : first)
            for_steps(rays, sample_of(id, rays.n), [&](const std::array<int, 3>& s) {
                const SampleId to = id_of(s, rays.n);
                if (!found.contains(to) && allowed(s, to)) {
                    found.emplace(to, level);
                    next.push_back(to);
                }
            });
        first = std::move(next);
    }
    return found;
}

} // namespace glcast
