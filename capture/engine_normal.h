// The normal pass of one view: normals painted by lights, read back as vectors.
#pragma once
#include "capture/engine_pass.h"

namespace glcast {

/// Fills image.normal in the part of the image that `view` draws. The target holds the depth of the view's
/// colour pass, and image.depth the same; `view` is that pass, or it in a part that holds all that it covers.
void capture_normals(PassRunner& passes, const Target& target, const Pass& view, NormalMethod method,
                     ViewImage& image);

} // namespace glcast
