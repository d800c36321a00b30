// Surfaces of no thickness, outside on both sides: the samples that stand for them.
#pragma once
#include "tools/reconstruct/step.h"

namespace glcast {

/// The sample nearest to each hit that has no filled sample on either side, unless it is the last sliver of a
/// thick body.
std::vector<SampleId> sheet_samples(const Rays& rays, const SliceHits& along_z, const Volume& filled);

} // namespace glcast
