// Small text in a picture. Internal.
#pragma once
#include <string>

#include "tools/render/render.h"

namespace glcast {

constexpr int label_height = 8; ///< pixels of a line at scale 1, the tails of letters left out

/// Draw `text` with its upper left corner at x, y; every pixel of the font is `scale` pixels wide. What does
/// not fit is cut off.
void draw_label(Picture& picture, int x, int y, std::string text, int scale, std::uint8_t grey);
int label_width(std::string text, int scale);

} // namespace glcast
