// Which samples are filled by the paper's rule: those between first and last hit along all three axes.
// Natvig 2006, section 3.
#pragma once
#include "tools/reconstruct/rays.h"

namespace glcast {

struct Carved {
    Volume volume;
    std::size_t thin_samples = 0; ///< filled only because a sheet or thin wall passes by
};

/// From the first and last hit of each ray alone. `close_gaps`: radius in samples (closing.h); 0 keeps gaps.
Carved carve_along_axes(const Rays& rays, double close_gaps);

} // namespace glcast
