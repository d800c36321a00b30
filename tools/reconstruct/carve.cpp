#include "tools/reconstruct/carve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tbb/parallel_for.h>

#include "tools/reconstruct/closing.h"

namespace glcast {
namespace {

/// A sheet passes between two samples (then first == last, one of these), or a thin wall runs just before the
/// first or after the last sample.
enum Keep : std::uint8_t { keep_between = 1, keep_first = 2, keep_last = 4 };

/// What one axis leaves.
struct AxisSpans {
    EndDepths depth;                       ///< first and last hit as captured
    std::vector<std::int16_t> first, last; ///< samples left filled, first > last where none; gaps are closed
    std::vector<std::uint8_t> keep;        ///< samples that stay whatever the other axes say: bits of Keep
};

struct Spans {
    int n;
    std::array<AxisSpans, 3> axis;

    std::size_t pixel(int a, const std::array<int, 3>& s) const { return pixel_of(a, s, n); }
    bool left_by(int a, const std::array<int, 3>& s) const {
        const std::size_t p = pixel(a, s);
        return axis[a].first[p] <= s[a] && s[a] <= axis[a].last[p];
    }
    bool left_by_all(const std::array<int, 3>& s) const {
        return left_by(0, s) && left_by(1, s) && left_by(2, s);
    }
};

EndDepths ends_of(const AxisHits& hits) {
    EndDepths out;
    const std::size_t pixels = hits.start.size() - 1;
    out.front.resize(pixels);
    out.back.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        out.front[p] = hits.front(p);
        out.back[p] = hits.back(p);
    }
    return out;
}

struct Span {
    float front, back;
    bool hit() const { return front < no_depth; }
    bool holds_sample() const { return hit() && std::ceil(front) <= std::floor(back); }
    float middle() const { return 0.5f * (front + back); }
};

Span span_at(const AxisSpans& rays, int n, int u, int v) {
    if (u < 0 || v < 0 || u >= n || v >= n) return {no_depth, -no_depth};
    const std::size_t p = std::size_t(v) * n + u;
    return {rays.depth.front[p], rays.depth.back[p]};
}

constexpr float far = 4; // samples: a steep sheet may go on so much deeper in the next pixel

/// What a ray holds too little of: the last sliver of a thick body, where it curves away from the ray, or a
/// sheet? A sliver has the thick body (samples that stay) on one side and nothing on the other.
template <class Stays>
bool is_sheet(const AxisSpans& rays, int n, int u, int v, float front, float back, Stays stays) {
    for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) {
            if (!du && !dv) continue;
            const Span beyond = span_at(rays, n, u - du, v - dv);
            const bool open = !beyond.hit() || beyond.front > back + far || beyond.back < front - far;
            if (open && stays(u + du, v + dv)) return false;
        }
    return true;
}

void find_samples(AxisSpans& rays, int n, const EndDepths& closed) {
    const std::size_t pixels = std::size_t(n) * n;
    rays.first.assign(pixels, 32767);
    rays.last.assign(pixels, -1);
    rays.keep.assign(pixels, 0);
    for (int v = 0; v < n; ++v)
        for (int u = 0; u < n; ++u) {
            const std::size_t p = std::size_t(v) * n + u;
            const Span span{closed.front[p], closed.back[p]};
            if (!span.hit()) continue;
            const auto thick = [&](int qu, int qv) {
                const Span body = span_at(rays, n, qu, qv);
                return body.holds_sample() && body.front < span.back + 1 && body.back > span.front - 1;
            };
            if (span.holds_sample()) {
                rays.first[p] = std::int16_t(std::ceil(span.front));
                rays.last[p] = std::int16_t(std::floor(span.back));
            } else if (is_sheet(rays, n, u, v, span.front, span.back, thick)) {
                rays.first[p] = rays.last[p] =
                    std::int16_t(std::clamp(int(std::lround(span.middle())), 0, n - 1));
                rays.keep[p] = keep_between;
            }
        }
}

/// Does an axis see past the sample, and not just graze it?
bool is_carved(const Spans& rays, const std::array<int, 3>& s) {
    constexpr float grazing = 0.05f; // samples, far above the noise of the depths
    for (int a = 0; a < 3; ++a) {
        const std::size_t p = rays.pixel(a, s);
        const float at = float(s[a]);
        if (rays.left_by(a, s)) continue;
        if (at < rays.axis[a].depth.front[p] - grazing || at > rays.axis[a].depth.back[p] + grazing)
            return true;
    }
    return false;
}

/// A wall thinner than a sample around a hollow that another axis looks into (the spout of the teapot): the
/// sample behind the hit would be carved, and the wall with it.
void keep_thin_walls(const Spans& rays, int a, int side, int v, std::vector<std::uint8_t>& kept) {
    const AxisSpans& axis = rays.axis[a];
    const ImageAxes image = image_axes(Axis(a));
    const auto& ends = side ? axis.last : axis.first;
    const auto sample_at = [&](int u, int w) {
        std::array<int, 3> s;
        s[image.u] = u;
        s[image.v] = w;
        s[image.depth] = ends[std::size_t(w) * rays.n + u];
        return s;
    };
    for (int u = 0; u < rays.n; ++u) {
        const std::size_t p = std::size_t(v) * rays.n + u;
        const float hit = (side ? axis.depth.back : axis.depth.front)[p];
        if (axis.first[p] > axis.last[p] || axis.keep[p] || !(std::abs(hit - float(ends[p])) <= 1)) continue;
        if (!is_carved(rays, sample_at(u, v))) continue;
        const auto stays = [&](int qu, int qv) {
            if (qu < 0 || qv < 0 || qu >= rays.n || qv >= rays.n) return false;
            const std::array<int, 3> s = sample_at(qu, qv);
            return s[image.depth] >= 0 && s[image.depth] < rays.n &&
                   std::abs(float(s[image.depth]) - hit) < 2 && rays.left_by_all(s);
        };
        kept[p] = is_sheet(axis, rays.n, u, v, hit, hit, stays);
    }
}

void keep_all_thin_walls(Spans& rays) {
    const int n = rays.n;
    std::array<std::vector<std::uint8_t>, 6> kept;
    for (int i = 0; i < 6; ++i) {
        kept[i].assign(std::size_t(n) * n, 0);
        tbb::parallel_for(0, n, [&](int v) { keep_thin_walls(rays, i / 2, i % 2, v, kept[i]); });
    }
    for (int i = 0; i < 6; ++i)
        for (std::size_t p = 0; p < kept[i].size(); ++p)
            if (kept[i][p]) rays.axis[i / 2].keep[p] |= i % 2 ? keep_last : keep_first;
}

/// Fills rows from the three images that cross them.
class Sweep {
  public:
    explicit Sweep(const Spans& rays) : rays(rays), n(rays.n), bytes(words_of(n) * 64), bits(words_of(n)) {}
    void fill(int z, SliceRuns& slice) {
        for (int y = 0; y < n; ++y)
            if (fill_row(y, z))
                slice.add_row(bits.data(), n);
            else
                slice.add_empty_row();
    }

  private:
    bool fill_row(int y, int z) {
        const std::size_t in_x = std::size_t(z) * n + y, in_y = std::size_t(z) * n, in_z = std::size_t(y) * n;
        const int first = rays.axis[0].first[in_x], last = rays.axis[0].last[in_x];
        if (first > last) return false;
        const std::int16_t *y0 = &rays.axis[1].first[in_y], *y1 = &rays.axis[1].last[in_y];
        const std::int16_t *z0 = &rays.axis[2].first[in_z], *z1 = &rays.axis[2].last[in_z];
        const std::int16_t here_y = std::int16_t(y), here_z = std::int16_t(z);
        std::fill(bytes.begin(), bytes.end(), 0);
        for (int x = first; x <= last; ++x)
            bytes[x] = (y0[x] <= here_y) & (here_y <= y1[x]) & (z0[x] <= here_z) & (here_z <= z1[x]);
        pack();
        return true;
    }
    void pack() {
        for (std::size_t w = 0; w < bits.size(); ++w) {
            Word word = 0;
            for (int k = 0; k < 8; ++k) {
                std::uint64_t eight;
                std::memcpy(&eight, &bytes[w * 64 + k * 8], 8);
                word |= (eight * 0x0102040810204080ull >> 56) << (8 * k);
            }
            bits[w] = word;
        }
    }

    const Spans& rays;
    const int n;
    std::vector<std::uint8_t> bytes; ///< byte x is sample x
    std::vector<Word> bits;
};

Volume between_all_hits(const Spans& rays) {
    std::vector<SliceRuns> slices(rays.n);
    tbb::parallel_for(0, rays.n, [&](int z) { Sweep(rays).fill(z, slices[z]); });
    return Volume(rays.n, slices);
}

std::vector<SampleId> kept_samples(const Spans& rays) {
    std::vector<SampleId> out;
    const int n = rays.n;
    for (int a = 0; a < 3; ++a) {
        const AxisSpans& axis = rays.axis[a];
        const ImageAxes image = image_axes(static_cast<Axis>(a));
        const auto put = [&](std::size_t p, int depth) {
            std::array<int, 3> s;
            s[image.u] = int(p % n);
            s[image.v] = int(p / n);
            s[image.depth] = depth;
            out.push_back(id_of(s, n));
        };
        for (std::size_t p = 0; p < axis.keep.size(); ++p) {
            if (axis.keep[p] & (keep_between | keep_first)) put(p, axis.first[p]);
            if (axis.keep[p] & keep_last) put(p, axis.last[p]);
        }
    }
    return out;
}

} // namespace

Carved carve_along_axes(const Rays& rays, double close_gaps) {
    Spans spans{rays.n, {}};
    tbb::parallel_for(0, 3, [&](int a) {
        spans.axis[a].depth = ends_of(rays.axis[a]);
        find_samples(spans.axis[a], rays.n, close_depths(spans.axis[a].depth, rays.n, close_gaps));
    });
    keep_all_thin_walls(spans);
    Carved carved{between_all_hits(spans), 0};
    const std::size_t thick = carved.volume.samples();
    carved.volume.add(kept_samples(spans));
    carved.thin_samples = carved.volume.samples() - thick;
    return carved;
}

} // namespace glcast
