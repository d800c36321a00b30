// What the sight's coarse grid hides, sample by sample.
#pragma once
#include "tools/reconstruct/sight.h"
#include "tools/reconstruct/walls.h"

namespace glcast {

/// `space` without the samples in hidden cells and without those beside walls, which no cell holds whole,
/// that are nearer to hidden samples than to open ones.
Volume without_hidden(const Rays& rays, const SliceHits& along_z, const Volume& space, const Sight& sight);

} // namespace glcast
