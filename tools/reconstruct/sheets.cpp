#include "tools/reconstruct/sheets.h"

#include <algorithm>
#include <cmath>

namespace glcast {
namespace {

constexpr float far = 4; // samples: a steep sheet may go on so much deeper in the next pixel

/// The hits of one ray on one lattice edge, both ends of which are empty.
struct Stretch {
    int axis;
    std::array<int, 3> low;
    float front, back;
};

std::array<int, 3> beside(const Stretch& s, int du, int dv) {
    const ImageAxes image = image_axes(Axis(s.axis));
    std::array<int, 3> at = s.low;
    at[image.u] += du;
    at[image.v] += dv;
    return at;
}

bool nothing_near(const Rays& rays, const Stretch& s, int du, int dv) {
    const auto at = beside(s, du, dv);
    if (!rays.inside(at)) return true;
    const AxisHits& hits = rays.axis[s.axis];
    const std::size_t p = rays.pixel(s.axis, at);
    for (std::uint32_t i = hits.start[p]; i < hits.start[p + 1]; ++i)
        if (hits.depth[i] >= s.front - far && hits.depth[i] <= s.back + far) return false;
    return true;
}

bool body_near(const Volume& filled, const Stretch& s, int du, int dv) {
    auto at = beside(s, du, dv);
    const int from = int(std::ceil(s.front - 1)), to = int(std::floor(s.back + 1));
    for (at[s.axis] = from; at[s.axis] <= to; ++at[s.axis])
        if (filled.has(at)) return true;
    return false;
}

/// A sliver has the thick body on one side and nothing on the other.
bool is_sliver(const Rays& rays, const Volume& filled, const Stretch& s) {
    for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du)
            if ((du || dv) && body_near(filled, s, du, dv) && nothing_near(rays, s, -du, -dv)) return true;
    return false;
}

/// The hits of an edge with two empty ends that are no body's surface. A hit at a sample stands on the edges
/// on both sides of it; is a body behind the other one, then the hit is its.
bool find_stretch(const Rays& rays, const Volume& filled, Stretch& s) {
    const AxisHits& hits = rays.axis[s.axis];
    const std::size_t p = rays.pixel(s.axis, s.low);
    const float low = float(s.low[s.axis]), high = low + 1;
    auto before = s.low, after = s.low;
    before[s.axis] -= 1;
    after[s.axis] += 2;
    const bool body_before = filled.has(before), body_after = filled.has(after);
    s.front = no_depth;
    s.back = -no_depth;
    for (std::uint32_t i = hits.start[p]; i < hits.start[p + 1]; ++i) {
        const float t = hits.depth[i];
        if (t < low - on_sample || t > high + on_sample) continue;
        if ((body_before && t < low + on_sample) || (body_after && t > high - on_sample)) continue;
        s.front = std::min(s.front, t);
        s.back = std::max(s.back, t);
    }
    return s.front <= s.back;
}

class Finder {
  public:
    Finder(const Rays& rays, const SliceHits& along_z, const Volume& filled)
        : rays(rays), filled(filled), n(rays.n), words(words_of(n)), walls(rays, along_z) {
        for (auto& slice : slices) slice.resize(words * n);
    }
    void slice(int z, std::vector<SampleId>& out) {
        fill(z, slices[0]);
        fill(z + 1, slices[1]);
        walls.load(z);
        for (int y = 0; y < n; ++y)
            for (std::size_t w = 0; w < words; ++w) {
                const Word* row = &slices[0][words * y];
                Word full_x = moved_down(row, w, words);
                add(walls.x(y)[w] & ~row[w] & ~full_x, w, 0, y, z, out);
                if (y + 1 < n) add(walls.y(y)[w] & ~row[w] & ~row[w + words], w, 1, y, z, out);
                if (z + 1 < n) add(walls.above(y)[w] & ~row[w] & ~slices[1][words * y + w], w, 2, y, z, out);
            }
    }

  private:
    void fill(int z, std::vector<Word>& out) const {
        std::fill(out.begin(), out.end(), 0);
        if (z < n)
            for (int y = 0; y < n; ++y) filled.set_bits(y, z, &out[words * y]);
    }
    void add(Word edges, std::size_t w, int axis, int y, int z, std::vector<SampleId>& out) const {
        for (; edges; edges &= edges - 1) {
            Stretch s{axis, {int(w * 64) + std::countr_zero(edges), y, z}, 0, 0};
            if (s.low[0] >= n || !find_stretch(rays, filled, s) || is_sliver(rays, filled, s)) continue;
            std::array<int, 3> at = s.low;
            at[axis] += 0.5f * (s.front + s.back) > float(s.low[axis]) + 0.5f;
            out.push_back(id_of(at, n));
        }
    }
    const Rays& rays;
    const Volume& filled;
    const int n;
    const std::size_t words;
    Walls walls;
    std::vector<Word> slices[2];
};

} // namespace

std::vector<SampleId> sheet_samples(const Rays& rays, const SliceHits& along_z, const Volume& filled) {
    std::vector<std::vector<SampleId>> found(rays.n);
    for_slabs(rays.n, [&](int z0, int z1) {
        Finder finder(rays, along_z, filled);
        for (int z = z0; z < z1; ++z) finder.slice(z, found[z]);
    });
    std::vector<SampleId> out;
    for (const auto& slice : found) out.insert(out.end(), slice.begin(), slice.end());
    return out;
}

} // namespace glcast
