// Which samples are filled when every surface along the lattice lines is known: those that the outside does
// not reach, or that nobody outside can see (docs/design/method.md, "Exterior").
#pragma once
#include <span>

#include "tools/reconstruct/rays.h"

namespace glcast {

struct Exterior {
    Volume volume;                  ///< filled
    std::size_t thin_samples = 0;   ///< filled only because a sheet or thin wall passes by
    std::size_t hidden_samples = 0; ///< free and reached, but out of sight
};

/// Needs complete layers. Outside is what free space reaches from the border of the box through passages
/// wider than 2 `close_gaps` + 1 samples and what can be seen from far away (sight.h). 0 keeps every passage.
///
/// `eyes`: samples from which something is seen from within. The free space in which one of them stands is
/// outside too, all of it where nothing joins it to the border, and else the chamber that it stands in. Where
/// it is outside anyway, nothing changes.
Exterior find_exterior(const Rays& rays, double close_gaps, std::span<const SampleId> eyes = {});

} // namespace glcast
