// The promise of reconstruct(), asserted.
#pragma once
#include <span>

#include "tools/mesh/mesh.h"

namespace glcast {

/// Throws std::logic_error unless the triangles are a closed two-manifold: around every vertex they form
/// exactly one closed fan, which implies that each directed edge occurs once and its opposite once.
void assert_manifold(std::span<const Triangle> triangles, std::size_t vertices);

} // namespace glcast
