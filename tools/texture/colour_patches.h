// A level of few colours that do not mix: each triangle gets one of them.
#pragma once
#include "tools/mesh/level.h"

namespace glcast {

/// Where what the level's corners show are a few plain colours, each over patches of the surface, every triangle gets
/// that of its patch: the mean of it, by area. Triangles across a border get the nearer colour. False, and the level as it was,
/// where colours run into one another, are more than `most_face_colours`, or the level has none. Whether what
/// comes of it is right is the caller's to measure.
bool take_patch_colours(Level& level);

} // namespace glcast
