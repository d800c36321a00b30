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

/// What is worked on shrinks to the rectangle of the pixels in which something may still be found: it is all
/// that is drawn, read and gone through.
class AxisPeeler {
  public:
    AxisPeeler(const LayerTask& task, const PeelShader& shader, const OuterHits& hits)
        : task(task), shader(shader), n(task.target.size()), ranges(hits.first.size()),
          tiles(task.box, task.axis, n) {
        for (std::size_t p = 0; p < ranges.size(); ++p)
            ranges[p] = {hits.first[p], -1, has_room(hits.first[p], hits.last[p], n) ? hits.last[p] : closed};
        open = bounds_of(PixelRect::whole(n), n, [&](std::size_t p) { return is_open(p); });
        pass.box = task.box;
        pass.axis = task.axis;
        pass.side = Side::minus;
        pass.open = &tiles;
    }

    AxisLayers run(const LayerSink& sink) {
        AxisLayers layers;
        ViewImage image;
        for (;; ++layers.count) {
            const bool wanted = layers.count < task.most; // else: is there anything left?
            const PixelRect drawn = open;
            renew(image, {task.axis, Side::minus, layers.count});
            const bool any = find(image, wanted);
            if (differs) return {.count = 1, .complete = false, .usable = false};
            layers.complete = !any && !given_up && !task.passes.saw_own_program();
            if (!any || !wanted) return layers;
            layers.stopped = !sink(std::move(image));
            if (layers.stopped) return layers;
            last_drawn = drawn;
        }
    }

  private:
    bool is_open(std::size_t pixel) const { return ranges[pixel].last != closed; }

    /// Blank; what a sink has not taken is used again, and only cleaned where it was drawn into.
    void renew(ViewImage& image, const View& view) const {
        if (image.depth.size() != ranges.size() || image.colour.size() != ranges.size() ||
            image.normal.size() != ranges.size()) {
            image = blank_image(view, n);
            return;
        }
        image.view = view;
        for_each_pixel(last_drawn, n, [&](std::size_t p) {
            image.depth[p] = ViewImage::background(view.side);
            image.colour[p] = image.normal[p] = glm::vec4(0);
            if (!image.other_colour.empty()) image.other_colour[p] = image.other_normal[p] = glm::vec4(0);
        });
    }

    /// The next hit of every pixel. False when there is none.
    bool find(ViewImage& image, bool with_normals) {
        bool any = false;
        std::optional<ViewImage> more; // hits behind holes
        const PixelRect layer = open;
        for (int round = 0; !open.empty(); ++round) {
            peel();
            const long candidates = count_candidates();
            if (candidates == 0) break;
            if (round == 1) more = blank_layer(n, task.axis, image.view.layer);
            ViewImage& now = round == 0 ? image : *more;
            const long shown = take_shown(now);
            any |= shown > 0;
            if (with_normals && shown > 0) take_normals(now);
            if (round == 0 && image.view.layer == 1 && 2 * shown < candidates && !check_depths())
                return false;
            if (round > 0) merge(*more, image);
            if (shown == candidates) break;
            given_up = ++hole_rounds >= most_hole_rounds;
            if (given_up) break;
            open = bounds_of(open, n, [&](std::size_t p) { return is_open(p) && ranges[p].passed != found; });
        }
        step_behind(image, layer);
        return any;
    }

    void peel() {
        tiles.close_all();
        for_each_pixel(open, n, [&](std::size_t p) {
            if (is_open(p)) tiles.open(p, std::max(ranges[p].before, ranges[p].passed), ranges[p].last);
        });
        shader.upload(ranges, open);
        pass.kind = PassKind::peel;
        pass.depth = DepthRule::first;
        pass.shader = &shader;
        pass.only = open;
        task.passes.run(pass, task.target);
        task.target.read_depth(depth, open);
    }

    long count_candidates() const {
        long candidates = 0;
        for_each_pixel(open, n, [&](std::size_t p) { candidates += depth[p] < 1; });
        return candidates;
    }

    /// The fixed fragment stage at the depths that were peeled: colours, and which of them are no holes.
    long take_shown(ViewImage& image) {
        tiles.close_all();
        for_each_pixel(open, n, [&](std::size_t p) {
            if (depth[p] < 1) tiles.open(p, depth[p], depth[p]);
        });
        pass.kind = PassKind::colour;
        pass.depth = DepthRule::equal;
        task.passes.run(pass, task.target);
        task.target.read_stencil(marks, open);
        blend_coincident(task.passes, task.target, pass);
        read_blended(task.target, image.colour, open);
        long shown = 0;
        for_each_pixel(open, n, [&](std::size_t p) {
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
        });
        return shown;
    }

    void take_normals(ViewImage& image) {
        const SeenSides sides = see_sides(task.passes, task.target, pass, task.sides, task.normals, image);
        capture_normals(task.passes, task.target, pass, task.normals, image);
        take_sides(sides, open, image);
    }

    void merge(const ViewImage& from, ViewImage& to) const {
        for_each_pixel(open, n, [&](std::size_t p) {
            if (!from.covered(p)) return;
            to.depth[p] = from.depth[p];
            to.colour[p] = from.colour[p];
            to.normal[p] = from.normal[p];
            if (from.other_colour.empty() || to.other_colour.empty()) return;
            to.other_colour[p] = from.other_colour[p];
            to.other_normal[p] = from.other_normal[p];
        });
    }

    void step_behind(const ViewImage& image, const PixelRect& layer) {
        for_each_pixel(layer, n, [&](std::size_t p) {
            const float before = image.depth[p];
            const bool stays = image.covered(p) && has_room(before, ranges[p].last, n);
            ranges[p] = {image.covered(p) ? before : ranges[p].before, -1, stays ? ranges[p].last : closed};
        });
        open = bounds_of(layer, n, [&](std::size_t p) { return is_open(p); });
    }

    /// The first hits as the shader sees them must be those of the fixed fragment stage to the bit, else
    /// nothing is at equal depth. A hole makes a difference too, but not one within rounding. Draws over the
    /// target's depth.
    bool check_depths() {
        std::vector<PeelRange> all(ranges.size(), {-1, -1, 3});
        std::swap(all, ranges);
        peel();
        std::swap(all, ranges);
        long covered = 0, off = 0;
        for_each_pixel(open, n, [&](std::size_t p) {
            if (ranges[p].before == ViewImage::background(Side::minus)) return;
            ++covered;
            const float by = std::abs(depth[p] - ranges[p].before);
            off += by != 0 && by <= SameHit::flat / static_cast<float>(n);
        });
        differs = off * 100 > covered;
        return !differs;
    }

    const LayerTask& task;
    const PeelShader& shader;
    const int n;
    std::vector<PeelRange> ranges;
    std::vector<float> depth;
    std::vector<std::uint8_t> marks;
    PixelRect open, last_drawn;
    OpenTiles tiles;
    Pass pass;
    int hole_rounds = 0;
    bool given_up = false, differs = false;
};

} // namespace

bool has_room(float first, float last, int n) {
    constexpr float rounding = 0x1p-22f; // of the shader's sums
    return last - first > 2 * SameHit::flat / static_cast<float>(n) - rounding;
}

PixelRect room_between(const OuterHits& hits, int n) {
    return bounds_of(PixelRect::whole(n), n,
                     [&](std::size_t p) { return has_room(hits.first[p], hits.last[p], n); });
}

ViewImage blank_layer(int n, Axis axis, int layer) { return blank_image({axis, Side::minus, layer}, n); }

AxisLayers peel_axis(const LayerTask& task, const PeelShader& shader, const OuterHits& hits,
                     const LayerSink& sink) {
    return AxisPeeler(task, shader, hits).run(sink);
}

} // namespace glcast
