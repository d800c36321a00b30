// Which draws of a group are outlines: hulls close around other things, of which culling leaves only the far
// side (cartoon outlines, halos). In the window they are a rim about the things; cast, they would hide them.
// Knows no GL.
//
// The rule. Draws that follow one another, are culled alike and share corners are one piece. A piece is an
// outline when
//
//   its shown sides face inward (its volume is negative when they are taken for the outer ones), the eye is
//   not in it, and no corner of it is farther from what is in it, and is no such hull itself, than an eighth
//   of its width; or a fourth where it leaves room on all six sides.
//
// The same faces drawn by another piece that is culled the other way make it a sheet with two sides, and no
// outline. A room is none, as things in it stand on its floor and away from its corners.
#pragma once
#include "shim/preload/draw_shape.h"

namespace glcast::preload {

/// By draw. `right_handed`: a polygon that is counter-clockwise in the window has its normal, by the right
/// hand, on the side from which it is seen.
std::vector<bool> find_outlines(const std::vector<DrawShape>& shapes, const glm::dvec3& eye,
                                bool right_handed);

} // namespace glcast::preload
