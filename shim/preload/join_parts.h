// Parts of a draw in one list of elements, so that they take one call.
#pragma once
#include <vector>

#include "shim/record/record.h"

namespace glcast::preload {

/// Is that worth its list? Long parts are better drawn as they are. The mode is one whose draws have parts.
bool are_to_be_joined(const std::vector<record::DrawParts::Part>& parts);

/// Elements of all parts, counted from the draw's first. Those of strips are joined by faces without area,
/// and each part begins at an even place, so that its triangles turn as before.
std::vector<GLuint> join_parts(GLenum mode, const std::vector<record::DrawParts::Part>& parts);

} // namespace glcast::preload
