#include "tests/pictures/own_size.h"

#include <cmath>
#include <stdexcept>

namespace glcast::pictures {

std::vector<OwnSize> own_sizes(std::span<const Level> levels, const Level& full,
                               std::span<const ReferenceView> views) {
    const int width = views[0].camera.width;
    std::vector<int> samples; // a pixel
    for (const Level& level : levels) {
        const int pixels = int(std::lround(level.pixels));
        if (pixels <= 0 || width % pixels)
            throw std::invalid_argument(level.name + ": the views are no whole number of times as wide");
        samples.push_back(width / pixels);
    }
    const std::vector<PictureError> best = picture_errors(full, views, samples);
    std::vector<OwnSize> sizes;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const PictureError shown = picture_error(levels[k], views, samples[k]);
        sizes.push_back({width / samples[k], shown.antialiased, best[k].antialiased, shown.psnr_outline,
                         shown.psnr_filling});
    }
    return sizes;
}

bool looks_right(const OwnSize& size, bool finest) {
    const bool near_full = size.level.psnr >= size.full.psnr - hardly_worse;
    return near_full || (!finest && size.level.psnr >= good_picture);
}

} // namespace glcast::pictures
