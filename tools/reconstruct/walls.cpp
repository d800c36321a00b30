#include "tools/reconstruct/walls.h"

namespace glcast {

SliceHits::SliceHits(const Rays& rays) : start(std::size_t(rays.n) + 1, 0) {
    const AxisHits& z = rays.axis[2];
    const int n = rays.n;
    for (float depth : z.depth) for_crossed_edges(depth, n, [&](int i) { ++start[i + 1]; });
    for (int i = 0; i < n; ++i) start[i + 1] += start[i];
    hits.resize(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const std::size_t p = std::size_t(y) * n + x;
            for (std::uint32_t i = z.start[p]; i < z.start[p + 1]; ++i)
                for_crossed_edges(z.depth[i], n, [&](int slice) {
                    hits[next[slice]++] = {std::uint16_t(x), std::uint16_t(y)};
                });
        }
}

Walls::Walls(const Rays& rays, const SliceHits& along_z)
    : words(words_of(rays.n)), rays(rays), along_z(along_z), n(rays.n) {
    for (std::vector<Word>& bits : along) bits.resize(words * (n + 1));
}

void Walls::load_above(int z, std::vector<Word>& out) const {
    std::fill(out.begin(), out.end(), 0);
    if (z < 0 || z >= n) return;
    for (const SliceHits::At* at = along_z.begin(z); at != along_z.end(z); ++at)
        set_bit(&out[words * at->y], at->x);
}

void Walls::load(int z) {
    if (loaded == z - 1 && loaded >= 0)
        std::swap(along[2], along[3]);
    else
        load_above(z - 1, along[3]);
    load_above(z, along[2]);
    loaded = z;
    std::fill(along[0].begin(), along[0].end(), 0);
    std::fill(along[1].begin(), along[1].end(), 0);
    for (int i = 0; i < n; ++i) {
        const std::size_t p = std::size_t(z) * n + i; // pixel (u, z) of the x and of the y images
        for (int a = 0; a < 2; ++a) {
            const AxisHits& hits = rays.axis[a];
            for (std::uint32_t h = hits.start[p]; h < hits.start[p + 1]; ++h)
                for_crossed_edges(hits.depth[h], n, [&](int k) {
                    if (a == 0)
                        set_bit(&along[0][words * i], k);
                    else
                        set_bit(&along[1][words * (k + 1)], i);
                });
        }
    }
}

} // namespace glcast
