// What lies behind the places where the surface closes an opening. Internal.
// Unit of length: samples (hits.h).
#pragma once
#include "tools/reconstruct/rays.h"

namespace glcast {

struct HitBehind {
    int axis = 0;
    std::uint32_t hit = no_hit; ///< of rays.axis[axis]
    double away = 0;            ///< of the closing from the place, along the axis
    explicit operator bool() const { return hit != no_hit; }
};

int main_axis(const glm::vec3& v);

/// A narrow gap, or the mouth of what nobody can see into, is closed by surface that nobody drew
/// (exterior.h). Where the surface at most `reach` from `at` along the axis, on the side to which `facing`
/// (unit, outward) points, is such, the first hit behind it on that axis's ray, whichever way it faces: what
/// one sees who looks in. None where the surface was drawn, where nothing lies behind it, or where the rays
/// do not know every surface.
HitBehind hit_behind_closing(const Rays& rays, const glm::dvec3& at, const glm::vec3& facing, int axis,
                             double reach);

} // namespace glcast
