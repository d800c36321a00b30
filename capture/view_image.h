// The images of one view and one layer: what the engine makes and what the capture file holds.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "capture/view.h"

namespace glcast {

/// n x n pixels, row-major; row j = 0 is the smallest v (the bottom), column i = 0 the smallest u.
struct ViewImage {
    View view;
    int n = 0;
    std::vector<float>
        depth; ///< 0..1 through the box along +axis; `background(side)` where nothing was drawn
    std::vector<glm::vec4> colour; ///< as drawn, 0..1, not converted; a = 1 where something was drawn, else 0
    std::vector<glm::vec4> normal; ///< capture frame, as drawn (any length); w = 1 where there is one, else 0
    /// The same hits as a viewer on the other side would see them, were nothing in between; only in captures
    /// of both sides (CaptureInfo::both_sides), else empty: they look alike from there.
    std::vector<glm::vec4> other_colour, other_normal;
    /// CaptureInfo::reversed_backs: from there they look alike but for the reversed normal.
    bool reversed_backs = false;

    /// Depth of a pixel that nothing covers: 1 seen from minus, 0 seen from plus.
    static constexpr float background(Side side) { return side == Side::minus ? 1.0f : 0.0f; }
    bool covered(std::size_t pixel) const { return colour[pixel].a > 0; }
};

/// A view that shows nothing yet.
inline ViewImage blank_image(const View& view, int n) {
    const std::size_t pixels = std::size_t(n) * n;
    return {view,
            n,
            std::vector<float>(pixels, ViewImage::background(view.side)),
            std::vector<glm::vec4>(pixels, glm::vec4(0)),
            std::vector<glm::vec4>(pixels, glm::vec4(0)),
            {},
            {}};
}

} // namespace glcast
