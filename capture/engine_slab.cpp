#include "capture/engine_slab.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "capture/engine_blend.h"
#include "capture/engine_normal.h"

namespace glcast {

namespace {

constexpr int most_slabs = 512;           ///< of an axis
constexpr double thinnest = 1.0 / 16;     ///< samples
constexpr double overlap = SameHit::flat; ///< samples, on both sides of a slab
/// In the mean over the image; together they are as large as two images.
constexpr double most_hits_per_pixel = 2.5;

/// Packed: many are held at a time. Colours are halves in the file too.
struct SlabHit {
    std::uint32_t pixel;
    float depth;
    glm::u16vec4 colour_and_flag; ///< halves; w is the normal's
    glm::vec3 normal;
};

struct Slab {
    double near, far; ///< depths 0..1 through the box
};

class AxisSlabs {
  public:
    AxisSlabs(const LayerTask& task, const OuterHits& outer)
        : task(task), outer(outer), n(task.target.size()), part(room_between(outer, n)) {
        pass.box = task.box;
        pass.axis = task.axis;
        pass.viewer = Side::minus;
        pass.only = part;
        pass.offsets = false; // a hit would be seen at one depth by one side, at another by the other
    }

    AxisLayers run(const LayerSink& sink) {
        search();
        merge();
        return send(sink);
    }

  private:
    void search() {
        std::vector<Slab> waiting{whole()};
        for (int slabs = 0; !waiting.empty(); ++slabs) {
            const Slab slab = waiting.back();
            waiting.pop_back();
            if (slabs == most_slabs || double(hits.size()) > most_hits_per_pixel * n * n) {
                complete = false;
                return;
            }
            if (look_into(slab)) continue;
            const double middle = 0.5 * (slab.near + slab.far);
            waiting.push_back({middle, slab.far});
            waiting.push_back({slab.near, middle});
        }
    }

    /// From the first hit of any ray to the last.
    Slab whole() const {
        Slab slab{1, 0};
        for (std::size_t p = 0; p < outer.first.size(); ++p) {
            if (outer.first[p] > outer.last[p]) continue;
            slab.near = std::min<double>(slab.near, outer.first[p]);
            slab.far = std::max<double>(slab.far, outer.last[p]);
        }
        return slab;
    }

    /// False when it must be cut in two.
    bool look_into(const Slab& slab) {
        pass.near = std::max(slab.near - overlap / n, 0.0);
        pass.far = std::min(slab.far + overlap / n, 1.0);
        draw(Side::minus, DepthRule::count);
        task.target.read_stencil(fragments, part);
        const int most = *std::max_element(fragments.begin(), fragments.end());
        if (most > 2 && slab.far - slab.near > thinnest / n) return false;
        if (most == 0) return true;
        take();
        if (most == 1) return true;
        if (most > 2) first = depth;
        draw(Side::plus, DepthRule::first);
        take();
        if (most > 2) judge_thinnest();
        return true;
    }

    void draw(Side side, DepthRule rule) {
        pass.kind = PassKind::colour;
        pass.side = side;
        pass.depth = rule;
        task.passes.run(pass, task.target);
    }

    /// What the pass that was drawn last shows of what lies between the outer hits.
    void take() {
        ViewImage image = blank_layer(n, task.axis, 1);
        task.target.read_depth(depth, part);
        const float nothing = ViewImage::background(pass.side);
        std::vector<std::uint8_t> inner(depth.size());
        bool any = false;
        for_each_pixel(part, n, [&](std::size_t p) {
            const bool drawn = fragments[p] > 0 && depth[p] != nothing;
            depth[p] = static_cast<float>(pass.near + depth[p] * (pass.far - pass.near));
            inner[p] = drawn && between(p, depth[p], SameHit::flat);
            any |= inner[p] != 0;
        });
        if (!any) return;
        blend_coincident(task.passes, task.target, pass);
        read_blended(task.target, image.colour, part);
        for_each_pixel(part, n, [&](std::size_t p) { image.colour[p].a = inner[p]; });
        capture_normals(task.passes, task.target, pass, task.normals, image);
        for_each_pixel(part, n, [&](std::size_t p) {
            if (!image.covered(p)) return;
            const glm::vec4 normal = image.normal[p];
            hits.push_back({static_cast<std::uint32_t>(p), depth[p],
                            glm::packHalf(glm::vec4(glm::vec3(image.colour[p]), normal.w)),
                            glm::vec3(normal)});
        });
    }

    bool between(std::size_t pixel, float z, float samples) const {
        const float apart = samples / static_cast<float>(n);
        return z - outer.first[pixel] > apart && outer.last[pixel] - z > apart;
    }

    /// More than two fragments in a slab that is not cut any more: one hit if they are that near.
    void judge_thinnest() {
        const float apart = SameHit::flat / static_cast<float>(n);
        for_each_pixel(part, n, [&](std::size_t p) {
            if (fragments[p] > 2 && depth[p] - first[p] > apart) complete = false;
        });
    }

    /// SameHit, by the slope that the captured normal tells.
    float apart_by(const SlabHit& hit) const {
        const ImageAxes axes = image_axes(task.axis);
        float slope = 0;
        if (hit.normal != glm::vec3(0))
            slope = (std::abs(hit.normal[axes.u]) + std::abs(hit.normal[axes.v])) /
                    std::max(std::abs(hit.normal[axes.depth]), 1e-6f);
        return std::min(SameHit::flat + SameHit::per_slope * slope, SameHit::most);
    }

    /// The depth check: each hit once, in order.
    void merge() {
        std::stable_sort(hits.begin(), hits.end(), [](const SlabHit& a, const SlabHit& b) {
            return a.pixel != b.pixel ? a.pixel < b.pixel : a.depth < b.depth;
        });
        const SlabHit* before = nullptr;
        const auto again = [&](const SlabHit& hit) {
            const float samples = apart_by(hit);
            const bool same = before && before->pixel == hit.pixel &&
                              hit.depth - before->depth <= samples / static_cast<float>(n);
            if (same || !between(hit.pixel, hit.depth, samples)) return true;
            before = &hit;
            return false;
        };
        std::vector<SlabHit> kept;
        kept.reserve(hits.size());
        for (const SlabHit& hit : hits)
            if (!again(hit)) kept.push_back(hit);
        hits = std::move(kept);
    }

    AxisLayers send(const LayerSink& sink) const {
        AxisLayers layers;
        for (;; ++layers.count) {
            ViewImage image = blank_layer(n, task.axis, layers.count);
            const bool any = fill(image);
            layers.complete = complete && !any;
            if (!any || layers.count == task.most) return layers;
            if (sink(std::move(image))) continue;
            layers.stopped = true;
            return layers;
        }
    }

    /// False when no pixel has so many hits.
    bool fill(ViewImage& image) const {
        bool any = false;
        int rank = 0;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            const SlabHit& hit = hits[k];
            rank = k > 0 && hits[k - 1].pixel == hit.pixel ? rank + 1 : 1;
            if (rank != image.view.layer) continue;
            image.depth[hit.pixel] = hit.depth;
            const glm::vec4 packed = glm::unpackHalf(hit.colour_and_flag);
            image.colour[hit.pixel] = glm::vec4(glm::vec3(packed), 1);
            image.normal[hit.pixel] = glm::vec4(hit.normal, packed.w);
            any = true;
        }
        return any;
    }

    const LayerTask& task;
    const OuterHits& outer;
    const int n;
    const PixelRect part; ///< all that is drawn, read and gone through
    Pass pass;
    std::vector<SlabHit> hits;
    std::vector<float> depth, first; ///< through the box; `first` of the thinnest slabs
    std::vector<std::uint8_t> fragments;
    bool complete = true;
};

} // namespace

AxisLayers slab_axis(const LayerTask& task, const OuterHits& hits, const LayerSink& sink) {
    return AxisSlabs(task, hits).run(sink);
}

} // namespace glcast
