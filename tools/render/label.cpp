#include "tools/render/label.h"

#include <algorithm>
#include <cstring>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace glcast {
namespace {

struct Corner { // as stb_easy_font writes it
    float x, y, z;
    std::uint8_t colour[4];
};

/// The font has ASCII only.
void replace_unknown(std::string& text) {
    for (char& c : text)
        if (c < 32 || c > 126) c = '?';
}

void fill(Picture& picture, int x0, int y0, int x1, int y1, std::uint8_t grey) {
    x0 = std::max(x0, 0), y0 = std::max(y0, 0);
    x1 = std::min(x1, picture.width), y1 = std::min(y1, picture.height);
    for (int y = y0; y < y1 && x0 < x1; ++y)
        std::memset(&picture.rgb[(std::size_t(y) * std::size_t(picture.width) + std::size_t(x0)) * 3], grey,
                    std::size_t(x1 - x0) * 3);
}

} // namespace

void draw_label(Picture& picture, int x, int y, std::string text, int scale, std::uint8_t grey) {
    replace_unknown(text);
    std::vector<Corner> corners(text.size() * 4 * 24 + 4); // no letter has more than 24 strokes
    const int strokes =
        stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(), int(corners.size() * sizeof(Corner)));
    for (int i = 0; i < strokes; ++i) {
        const Corner &low = corners[std::size_t(i) * 4], &high = corners[std::size_t(i) * 4 + 2];
        fill(picture, x + int(low.x) * scale, y + int(low.y) * scale, x + int(high.x) * scale,
             y + int(high.y) * scale, grey);
    }
}

int label_width(std::string text, int scale) {
    replace_unknown(text);
    return stb_easy_font_width(text.data()) * scale;
}

} // namespace glcast
