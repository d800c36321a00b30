// Connected free space: runs of samples along x, joined across rows where no wall stands between.
#pragma once
#include <span>

#include "tools/reconstruct/walls.h"

namespace glcast {

/// Samples at least `radius` samples away from every wall (0: all samples), as runs that no wall divides.
Volume wide_space(const Rays& rays, const SliceHits& along_z, int radius);

/// By run: is it connected with the border of the box? Runs of `space` on two rows are joined where they
/// overlap and, when `radius` is 0, no wall divides them there.
std::vector<std::uint8_t> connected_to_border(const Rays& rays, const SliceHits& along_z, const Volume& space,
                                              int radius);

/// The runs that are marked.
Volume marked_runs(const Volume& space, std::span<const std::uint8_t> marks);

/// `space` and the samples one step from it across an edge without a wall.
Volume grown(const Rays& rays, const SliceHits& along_z, const Volume& space);

/// The samples that grown() would add, ascending.
std::vector<SampleId> beside(const Rays& rays, const SliceHits& along_z, const Volume& space);

} // namespace glcast
