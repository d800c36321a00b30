// Which hits are the surface, and which lie inside the body that it bounds.
#pragma once
#include "tools/reconstruct/rays.h"

namespace glcast {

/// A hit is the surface seen from plus when the sample above it is empty and the one below filled, from minus
/// the other way round; a sheet is both.
enum HitSides : std::uint32_t { seen_from_minus = 1u << 30, seen_from_plus = 1u << 31 };

/// Sets these bits in the colours of all hits, from the volume.
void mark_sides(Rays& rays);

} // namespace glcast
