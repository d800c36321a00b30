// Steps from sample to sample through free space, for sets too sparse to be worth a sweep of the volume.
#pragma once
#include <cmath>

#include "tools/reconstruct/walls.h"

namespace glcast {

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

/// A level for each of some samples: open addressing, which is several times as fast here as
/// std::unordered_map.
class SampleLevels {
  public:
    static constexpr int none = -1;

    int at(SampleId id) const {
        if (slots.empty()) return none;
        for (std::size_t i = slot(id);; i = (i + 1) & (slots.size() - 1)) {
            if (slots[i].id == id) return slots[i].level;
            if (slots[i].id == empty) return none;
        }
    }
    bool contains(SampleId id) const { return at(id) != none; }
    /// False when it has a level already.
    bool add(SampleId id, int level) {
        if (2 * (count + 1) > slots.size()) grow();
        std::size_t i = slot(id);
        for (; slots[i].id != empty; i = (i + 1) & (slots.size() - 1))
            if (slots[i].id == id) return false;
        slots[i] = {id, level};
        ++count;
        return true;
    }
    template <class Visit> void for_each(Visit visit) const {
        for (const Slot& each : slots)
            if (each.id != empty) visit(each.id, each.level);
    }

  private:
    static constexpr SampleId empty = ~SampleId(0);
    struct Slot {
        SampleId id = empty;
        int level = none;
    };
    std::size_t slot(SampleId id) const { return (id * 0x9e3779b97f4a7c15ull >> 20) & (slots.size() - 1); }
    void grow() {
        std::vector<Slot> old(std::max<std::size_t>(1024, 2 * slots.size()));
        old.swap(slots);
        count = 0;
        for (const Slot& each : old)
            if (each.id != empty) add(each.id, each.level);
    }
    std::vector<Slot> slots; ///< a power of two
    std::size_t count = 0;
};

/// Steps from a set, breadth first; `first` are the samples at level `level`. Goes on to samples that
/// allowed(s) and up to `most`. Returns the level of each.
template <class Allowed>
SampleLevels flood(const Rays& rays, std::vector<SampleId> first, int level, int most, Allowed allowed) {
    SampleLevels found;
    for (SampleId id : first) found.add(id, level);
    while (!first.empty() && level < most) {
        std::vector<SampleId> next;
        ++level;
        for (SampleId id : first)
            for_steps(rays, sample_of(id, rays.n), [&](const std::array<int, 3>& s) {
                const SampleId to = id_of(s, rays.n);
                if (!found.contains(to) && allowed(s, to)) {
                    found.add(to, level);
                    next.push_back(to);
                }
            });
        first = std::move(next);
    }
    return found;
}

} // namespace glcast
