#include "tools/texture/fill.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

struct Layer {
    int size = 0;
    std::vector<std::uint8_t> rgb, known;
};

/// Half the size: each texel the mean of what is known of four.
Layer pull(const Layer& fine) {
    Layer half{fine.size / 2, {}, {}};
    half.rgb.assign(std::size_t(half.size) * half.size * 3, 0);
    half.known.assign(std::size_t(half.size) * half.size, 0);
    tbb::parallel_for(0, half.size, [&](int y) {
        for (int x = 0; x < half.size; ++x) {
            int sum[3] = {}, count = 0;
            for (int k = 0; k < 4; ++k) {
                const std::size_t from = std::size_t(2 * y + k / 2) * fine.size + 2 * x + k % 2;
                if (!fine.known[from]) continue;
                ++count;
                for (int c = 0; c < 3; ++c) sum[c] += fine.rgb[3 * from + c];
            }
            if (!count) continue;
            const std::size_t to = std::size_t(y) * half.size + x;
            half.known[to] = 1;
            for (int c = 0; c < 3; ++c) half.rgb[3 * to + c] = std::uint8_t((sum[c] + count / 2) / count);
        }
    });
    return half;
}

/// Unknown texels from the layer of half the size, all of which is known, bilinear.
void push(const Layer& half, Layer& fine) {
    tbb::parallel_for(0, fine.size, [&](int y) {
        const int near_y = y / 2, far_y = std::clamp(near_y + (y % 2 ? 1 : -1), 0, half.size - 1);
        for (int x = 0; x < fine.size; ++x) {
            const std::size_t to = std::size_t(y) * fine.size + x;
            if (fine.known[to]) continue;
            const int near_x = x / 2, far_x = std::clamp(near_x + (x % 2 ? 1 : -1), 0, half.size - 1);
            const auto at = [&](int u, int v, int c) {
                return int(half.rgb[3 * (std::size_t(v) * half.size + u) + c]);
            };
            for (int c = 0; c < 3; ++c)
                fine.rgb[3 * to + c] = std::uint8_t((9 * at(near_x, near_y, c) + 3 * at(far_x, near_y, c) +
                                                     3 * at(near_x, far_y, c) + at(far_x, far_y, c) + 8) /
                                                    16);
        }
    });
}

} // namespace

void fill_unknown(Picture& picture, const std::vector<std::uint8_t>& known) {
    std::vector<Layer> layers;
    layers.push_back({picture.width, std::move(picture.rgb), known});
    while (layers.back().size > 1) layers.push_back(pull(layers.back()));
    for (std::size_t k = layers.size() - 1; k-- > 0;) push(layers[k + 1], layers[k]);
    picture.rgb = std::move(layers[0].rgb);
}

} // namespace glcast
