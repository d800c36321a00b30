#include "tools/reconstruct/rays.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tbb/parallel_for.h>

#include "tools/reconstruct/closing.h"
#include "tools/reconstruct/planes.h"

namespace glcast {
namespace {

const ViewImage& find_view(std::span<const ViewImage> images, Axis axis, Side side, int n) {
    const View wanted{axis, side, 0};
    const auto found = std::find_if(images.begin(), images.end(), [&](auto& i) { return i.view == wanted; });
    const std::string name = {side == Side::minus ? '-' : '+', "xyz"[static_cast<int>(axis)]};
    if (found == images.end()) throw std::runtime_error("the capture has no view " + name);
    const std::size_t pixels = std::size_t(n) * n;
    if (found->n != n || found->depth.size() != pixels || found->colour.size() != pixels ||
        found->normal.size() != pixels)
        throw std::runtime_error("view " + name + " has another size than the others");
    return *found;
}

/// A pixel counts as hit when one side saw something; what only one side saw has no thickness.
void read_depths(AxisRays& rays, int n) {
    const std::size_t pixels = std::size_t(n) * n;
    for (auto& depth : rays.depth) depth.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        float ends[2] = {no_depth, -no_depth};
        for (int side = 0; side < 2; ++side) {
            const float z = rays.image[side]->depth[p];
            if (rays.image[side]->covered(p) && z >= 0 && z <= 1) ends[side] = z * n - 0.5f;
        }
        if (ends[0] == no_depth) ends[0] = -ends[1];
        if (ends[1] == -no_depth) ends[1] = ends[0] == no_depth ? -no_depth : ends[0];
        if (ends[0] == no_depth && ends[1] != -no_depth) ends[0] = ends[1];
        if (std::isfinite(ends[0]) && ends[0] > ends[1]) std::swap(ends[0], ends[1]);
        rays.depth[0][p] = ends[0];
        rays.depth[1][p] = ends[1];
    }
}

struct Span {
    float front, back;
    bool hit() const { return front < no_depth; }
    bool holds_sample() const { return hit() && std::ceil(front) <= std::floor(back); }
    float middle() const { return 0.5f * (front + back); }
};

Span span_at(const AxisRays& rays, int n, int u, int v) {
    if (u < 0 || v < 0 || u >= n || v >= n) return {no_depth, -no_depth};
    const std::size_t p = std::size_t(v) * n + u;
    return {rays.depth[0][p], rays.depth[1][p]};
}

constexpr float far = 4; // samples: a steep sheet may go on so much deeper in the next pixel

/// What a ray holds too little of: the last sliver of a thick body, where it curves away from the ray, or a
/// sheet? A sliver has the thick body (samples that stay) on one side and nothing on the other.
template <class Stays>
bool is_sheet(const AxisRays& rays, int n, int u, int v, float front, float back, Stays stays) {
    for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) {
            if (!du && !dv) continue;
            const Span beyond = span_at(rays, n, u - du, v - dv);
            const bool open = !beyond.hit() || beyond.front > back + far || beyond.back < front - far;
            if (open && stays(u + du, v + dv)) return false;
        }
    return true;
}

void keep(AxisRays& rays, int n, int u, int v, Keep what) {
    rays.keep[std::size_t(v) * n + u] |= what;
    rays.row_keeps[v] = 1;
}

void find_samples(AxisRays& rays, int n, const ClosedDepths& closed) {
    const std::size_t pixels = std::size_t(n) * n;
    rays.first.assign(pixels, 32767);
    rays.last.assign(pixels, -1);
    rays.keep.assign(pixels, 0);
    rays.row_keeps.assign(n, 0);
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
                keep(rays, n, u, v, keep_between);
            }
        }
}

/// Does an axis see past the sample, and not just graze it?
bool is_carved(const Rays& rays, const std::array<int, 3>& s) {
    constexpr float grazing = 0.05f; // samples, far above the noise of the depths
    for (int a = 0; a < 3; ++a) {
        const std::size_t p = rays.pixel(a, s);
        const float at = float(s[a]);
        if (rays.left_by(a, s)) continue;
        if (at < rays.axis[a].depth[0][p] - grazing || at > rays.axis[a].depth[1][p] + grazing) return true;
    }
    return false;
}

/// A wall thinner than a sample around a hollow that another axis looks into (the spout of the teapot): the
/// sample behind the hit would be carved, and the wall with it.
void keep_thin_walls(const Rays& rays, int a, int side, int v, std::vector<std::uint8_t>& kept) {
    const AxisRays& axis = rays.axis[a];
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
        const float hit = axis.depth[side][p];
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

void keep_all_thin_walls(Rays& rays) {
    const int n = rays.n;
    std::array<std::vector<std::uint8_t>, 6> kept;
    for (int i = 0; i < 6; ++i) {
        kept[i].assign(std::size_t(n) * n, 0);
        tbb::parallel_for(0, n, [&](int v) { keep_thin_walls(rays, i / 2, i % 2, v, kept[i]); });
    }
    for (int i = 0; i < 6; ++i)
        for (int v = 0; v < n; ++v)
            for (int u = 0; u < n; ++u)
                if (kept[i][std::size_t(v) * n + u])
                    keep(rays.axis[i / 2], n, u, v, i % 2 ? keep_last : keep_first);
}

} // namespace

bool Rays::filled(const std::array<int, 3>& s) const {
    if (!inside(s)) return false;
    return left_by_all(s) || kept_by(0, s) || kept_by(1, s) || kept_by(2, s);
}

Rays make_rays(std::span<const ViewImage> images, double close_gaps) {
    if (images.empty()) throw std::runtime_error("the capture has no views");
    Rays rays;
    rays.n = images.front().n;
    if (rays.n < min_resolution || rays.n > max_resolution)
        throw std::runtime_error("resolution " + std::to_string(rays.n) + " is not in " +
                                 std::to_string(min_resolution) + ".." + std::to_string(max_resolution));
    for (int a = 0; a < 3; ++a)
        for (int side = 0; side < 2; ++side)
            rays.axis[a].image[side] = &find_view(images, Axis(a), Side(side), rays.n);
    tbb::parallel_for(0, 3, [&](int a) {
        read_depths(rays.axis[a], rays.n);
        find_samples(rays.axis[a], rays.n, close_depths(rays.axis[a], rays.n, close_gaps));
    });
    keep_all_thin_walls(rays);
    find_planes(rays);
    return rays;
}

} // namespace glcast
