#include "capture/engine_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "capture/engine_blend.h"
#include "capture/engine_normal.h"

namespace glcast {

namespace {

constexpr float closed = -1; ///< PeelRange::last where nothing is to be found any more
constexpr float found = 2;   ///< PeelRange::passed where this layer's hit is known

/// Draws for holes that an axis may cost before it is given up: a tree of a thousand leaves has that many.
constexpr int most_hole_rounds = 256;

class AxisPeeler {
  public:
    AxisPeeler(const LayerTask& task, const PeelShader& shader, const OuterHits& hits)
        : task(task), shader(shader), n(task.target.size()), ranges(hits.first.size()) {
        for (std::size_t p = 0; p < ranges.size(); ++p)
            ranges[p] = hits.first[p] <= hits.last[p] ? PeelRange{hits.first[p], -1, hits.last[p]}
                                                      : PeelRange{-1, -1, closed};
        pass.box = task.box;
        pass.axis = task.axis;
        pass.side = Side::minus;
    }

    AxisLayers run(const LayerSink& sink) {
        AxisLayers layers;
        for (;; ++layers.count) {
            const bool wanted = layers.count < task.most; // else: is there anything left?
            ViewImage image = blank_layer(n, task.axis, layers.count);
            const bool any = find(image, wanted);
            if (differs) return {.count = 1, .complete = false, .usable = false};
            layers.complete = !any && !given_up && !task.passes.saw_own_program();
            if (!any || !wanted) return layers;
            if (sink(std::move(image))) continue;
            layers.stopped = true;
            return layers;
        }
    }

  private:
    /// The next hit of every pixel. False when there is none.
    bool find(ViewImage& image, bool with_normals) {
        bool any = false;
        std::optional<ViewImage> more; // hits behind holes
        for (int round = 0;; ++round) {
            peel();
            const long candidates = std::count_if(depth.begin(), depth.end(), [](float z) { return z < 1; });
            if (candidates == 0) break;
            if (round > 0) more = blank_layer(n, task.axis, image.view.layer);
            ViewImage& now = round == 0 ? image : *more;
            const long shown = take_shown(now);
            any |= shown > 0;
            if (round == 0 && image.view.layer == 1 && 2 * shown < candidates && !check_depths())
                return false;
            if (with_normals && shown > 0) take_normals(now);
            if (round > 0) merge(*more, image);
            if (shown == candidates) break;
            given_up = ++hole_rounds >= most_hole_rounds;
            if (given_up) break;
        }
        step_behind(image);
        return any;
    }

    void peel() {
        shader.upload(ranges);
        pass.kind = PassKind::peel;
        pass.depth = DepthRule::first;
        pass.shader = &shader;
        task.passes.run(pass, task.target);
        task.target.read_depth(depth);
    }

    /// The fixed fragment stage at the depths that were peeled: colours, and which of them are no holes.
    long take_shown(ViewImage& image) {
        pass.kind = PassKind::colour;
        pass.depth = DepthRule::equal;
        task.passes.run(pass, task.target);
        task.target.read_stencil(marks);
        blend_coincident(task.passes, task.target, pass);
        read_blended(task.target, image.colour);
        long shown = 0;
        for (std::size_t p = 0; p < depth.size(); ++p) {
            const bool candidate = depth[p] < 1, hit = candidate && marks[p] != 0;
            PeelRange& range = ranges[p];
            if (hit)
                image.depth[p] = depth[p], range.passed = found;
            else if (candidate) // by a step at least: a depth buffer may round down
                range.passed = std::max(depth[p], range.passed + 0x1p-24f);
            else if (range.passed != found)
                range.last = closed;
            image.colour[p] = hit ? glm::vec4(glm::vec3(image.colour[p]), 1) : glm::vec4(0);
            shown += hit;
        }
        return shown;
    }

    void take_normals(ViewImage& image) {
        capture_normals(task.passes, task.target, pass, task.normals, image);
    }

    static void merge(const ViewImage& from, ViewImage& to) {
        for (std::size_t p = 0; p < from.depth.size(); ++p) {
            if (!from.covered(p)) continue;
            to.depth[p] = from.depth[p];
            to.colour[p] = from.colour[p];
            to.normal[p] = from.normal[p];
        }
    }

    void step_behind(const ViewImage& image) {
        for (std::size_t p = 0; p < ranges.size(); ++p) {
            if (image.covered(p))
                ranges[p] = {image.depth[p], -1, ranges[p].last};
            else
                ranges[p].last = closed;
        }
    }

    /// The first hits as the shader sees them must be those of the fixed fragment stage to the bit, else
    /// nothing is at equal depth. A hole makes a difference too, but not one within rounding.
    bool check_depths() {
        std::vector<PeelRange> open(ranges.size(), {-1, -1, 3});
        std::swap(open, ranges);
        peel();
        std::swap(open, ranges);
        long covered = 0, off = 0;
        for (std::size_t p = 0; p < ranges.size(); ++p) {
            if (ranges[p].before < 0) continue;
            ++covered;
            const float by = std::abs(depth[p] - ranges[p].before);
            off += by != 0 && by <= SameHit::flat / static_cast<float>(n);
        }
        differs = off * 100 > covered;
        return !differs;
    }

    const LayerTask& task;
    const PeelShader& shader;
    const int n;
    std::vector<PeelRange> ranges;
    std::vector<float> depth;
    std::vector<std::uint8_t> marks;
    Pass pass;
    int hole_rounds = 0;
    bool given_up = false, differs = false;
};

} // namespace

bool nothing_between(const OuterHits& hits, int n) {
    const float least = 2 * SameHit::flat / static_cast<float>(n);
    for (std::size_t p = 0; p < hits.first.size(); ++p)
        if (hits.last[p] - hits.first[p] > least) return false;
    return true;
}

ViewImage blank_layer(int n, Axis axis, int layer) { return blank_image({axis, Side::minus, layer}, n); }

AxisLayers peel_axis(const LayerTask& task, const PeelShader& shader, const OuterHits& hits,
                     const LayerSink& sink) {
    return AxisPeeler(task, shader, hits).run(sink);
}

} // namespace glcast
