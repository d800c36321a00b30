// Connected free space: runs of samples along x, joined across rows where no wall stands between.
#pragma once
#include <span>

#include "tools/reconstruct/walls.h"

namespace glcast {

/// Samples at least `radius` samples away from every wall (0: all samples), as runs that no wall divides.
Volume wide_space(const Rays& rays, const SliceHits& along_z, int radius);

/// What a run of space is connected with.
enum Connected : std::uint8_t {
    with_nothing,
    with_border, ///< of the box
    with_eye,    ///< and not with the border
};

/// By run. Runs of `space` on two rows are joined where they overlap and, when `radius` is 0, no wall divides
/// them there. `eyes`: samples of the space.
std::vector<std::uint8_t> connections(const Rays& rays, const SliceHits& along_z, const Volume& space,
                                      int radius, std::span<const SampleId> eyes);

/// The runs that have the mark.
Volume marked_runs(const Volume& space, std::span<const std::uint8_t> marks, std::uint8_t mark);

/// `space` and the samples one step from it across an edge without a wall.
Volume grown(const Rays& rays, const SliceHits& along_z, const Volume& space);

/// The samples that grown() would add, ascending.
std::vector<SampleId> beside(const Rays& rays, const SliceHits& along_z, const Volume& space);

} // namespace glcast
