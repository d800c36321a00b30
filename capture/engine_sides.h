// What the hits of an image look like from both sides, in frames that tell sides apart: by two-sided lighting
// with two materials, or by drawing fronts and backs in two culled passes.
#pragma once
#include <optional>

#include "capture/engine_pass.h"

namespace glcast {

/// How much more than one side is looked at.
struct SidesTask {
    bool both = false;  ///< the other side too
    bool culls = false; ///< faces that the program culls for a viewer have no part in what he sees, if others
                        ///< are there
};

/// Colours and normals of the same hits; covered where something was drawn.
struct SeenSides {
    std::optional<ViewImage> own, other;
};

/// Draws at the depth that is in the target, that of `hits`, after its colours were drawn by `view`.
SeenSides see_sides(PassRunner& passes, const Target& target, const Pass& view, const SidesTask& task,
                    NormalMethod normals, const ViewImage& hits);

/// Takes them into the image, where that is covered within `part`.
void take_sides(const SeenSides& seen, const PixelRect& part, ViewImage& image);

} // namespace glcast
