// Rectangles of pixels: what a pass draws into and what is read back of it.
#pragma once
#include <algorithm>
#include <cstddef>

namespace glcast {

/// Columns x0 to x1 - 1 of the rows y0 to y1 - 1; row 0 is the bottom.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }
    static PixelRect whole(int n) { return {0, 0, n, n}; }
};

/// `visit(pixel)` for each pixel of the rectangle, as an index into an n x n image.
template <class Visit> void for_each_pixel(const PixelRect& rect, int n, const Visit& visit) {
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(n);
        for (int x = rect.x0; x < rect.x1; ++x) visit(row + std::size_t(x));
    }
}

/// The smallest rectangle that holds all pixels of `within` for which `wanted(pixel)`; empty where there are
/// none.
template <class Wanted> PixelRect bounds_of(const PixelRect& within, int n, const Wanted& wanted) {
    PixelRect found{within.x1, within.y1, within.x0, within.y0};
    for (int y = within.y0; y < within.y1; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(n);
        int first = within.x0, last = within.x1 - 1;
        while (first <= last && !wanted(row + std::size_t(first))) ++first;
        if (first > last) continue;
        while (!wanted(row + std::size_t(last))) --last;
        found.x0 = std::min(found.x0, first), found.x1 = std::max(found.x1, last + 1);
        found.y0 = std::min(found.y0, y), found.y1 = y + 1;
    }
    return found.empty() ? PixelRect{} : found;
}

} // namespace glcast
