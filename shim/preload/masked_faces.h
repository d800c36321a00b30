// Faces that are drawn into the depth buffer alone, beside others with colours: they only hide what is behind
// them.
#pragma once
#include <span>

#include "shim/preload/scene_shapes.h"

namespace glcast::preload {

/// Triangles of the group that are drawn so, where the program's own view shows that it is otherwise with
/// them. 0 where they get their colours later, as in frames that begin with the depths. `group` is that of
/// all parts.
long masked_beside(const GlTable& gl, std::span<const ScenePart> parts, const Group& group);

} // namespace glcast::preload
