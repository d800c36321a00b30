// What a frame draws, told by its packets alone: nothing is replayed.
#pragma once
#include "shim/record/record.h"

namespace glcast::record {

struct FrameContents {
    long filled = 0;     ///< vertices of filled primitives, by kinds of call; evaluators and such count a few
    bool clears = false; ///< colours, of a whole framebuffer
    bool shows_images = false; ///< pixels, textures or draws under shaders: it may show an earlier picture
};
FrameContents contents_of(const Frame& frame);

} // namespace glcast::record
