#include "tests/pictures/own_size.h"

#include <cmath>
#include <stdexcept>

namespace glcast::pictures {

std::vector<OwnSize> own_sizes(std::span<const Level> levels, const Level& full,
                               std::span<const ReferenceView> views) {
    std::vector<OwnSize> sizes;
    for (const Level& level : levels) {
        const int width = views[0].camera.width, pixels = int(std::lround(level.pixels));
        if (pixels <= 0 || width % pixels)
            throw std::invalid_argument(level.name + ": the views are no whole number of times as wide");
        const PictureError shown = picture_error(level, views, width / pixels),
                           best = picture_error(full, views, width / pixels);
        sizes.push_back(
            {pixels, shown.antialiased, best.antialiased, shown.psnr_outline, shown.psnr_filling});
    }
    return sizes;
}

bool looks_right(const OwnSize& size, bool finest) {
    const bool near_full = size.level.psnr >= size.full.psnr - hardly_worse;
    return near_full || (!finest && size.level.psnr >= good_picture);
}

} // namespace glcast::pictures
