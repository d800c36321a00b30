#include "capture/engine.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <glm/glm.hpp>
#include <memory>

#include "capture/engine_blend.h"
#include "capture/engine_box.h"
#include "capture/engine_layers.h"
#include "capture/engine_normal.h"
#include "capture/engine_pass.h"
#include "capture/engine_slab.h"
#include "capture/engine_target.h"

namespace glcast {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Why a capture of n cannot be made here; empty when it can.
std::string obstacle(const GlTable& gl, int n) {
    if (!has_framebuffer_calls(gl)) return "no framebuffer objects in this OpenGL";
    if (n < min_resolution || n > max_resolution)
        return "n is " + std::to_string(n) + ", must be " + std::to_string(min_resolution) + " to " +
               std::to_string(max_resolution);
    const int largest = largest_target(gl);
    if (n > largest)
        return "n is " + std::to_string(n) + ", this OpenGL draws at most " + std::to_string(largest);
    return {};
}

std::string corner(const glm::dvec3& p) {
    char text[100];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
    return text;
}

std::optional<Box> find_box_with(const GlTable& gl, PassRunner& passes, const EngineOptions& options) {
    const Target target(gl, std::min(box_target_size(options.n), largest_target(gl)), false);
    if (!target.complete()) return std::nullopt;
    return search_box(passes, target, options.search, options.n);
}

class Capture {
  public:
    Capture(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options, const ImageSink& sink,
            EngineReport& report)
        : gl(gl), options(options), sink(sink), report(report), passes(gl, draw, options) {}

    void run() {
        report.error = obstacle(gl, options.n);
        if (report.error.empty()) find();
        if (report.error.empty()) capture_views();
        report.draws = passes.draws();
        swallow_errors(gl);
        report.ok = report.error.empty();
    }

  private:
    void find() {
        const auto start = Clock::now();
        const std::optional<Box> box = options.box ? options.box : find_box_with(gl, passes, options);
        report.box_seconds = seconds_since(start);
        if (!box)
            report.error = "nothing solid was drawn";
        else if (!(box->size > 0))
            report.error = "the box has no size";
        else
            report.box = *box;
    }

    void capture_views() {
        const Target target(gl, options.n, options.use_float_targets);
        if (!target.complete()) {
            report.error = "this OpenGL has no framebuffer of " + std::to_string(options.n) + " x " +
                           std::to_string(options.n);
            return;
        }
        report.float_targets = target.float_colour();
        if (options.most_layers > 1) choose_method();
        for (Axis axis : {Axis::x, Axis::y, Axis::z})
            if (!capture_axis(target, axis)) return;
        if (covered == 0)
            report.error = options.box
                               ? "nothing solid was drawn inside the box that was asked for, from " +
                                     corner(report.box.lo) + " to " + corner(report.box.lo + report.box.size)
                               : "nothing solid was drawn";
        if (options.most_layers > 1) judge_layers();
    }

    bool send(ViewImage&& image) {
        if (sink(std::move(image))) return true;
        report.error = "stopped by the receiver of the images";
        return false;
    }

    bool capture_axis(const Target& target, Axis axis) {
        OuterHits hits;
        for (Side side : {Side::minus, Side::plus}) {
            image.view = {axis, side, 0};
            image.n = options.n;
            capture_view(target);
            if (options.most_layers > 1) (side == Side::minus ? hits.first : hits.last) = image.depth;
            if (!send(std::move(image))) return false;
        }
        return options.most_layers <= 1 || capture_layers(target, axis, hits);
    }

    /// False when the receiver stopped.
    bool capture_layers(const Target& target, Axis axis, const OuterHits& hits) {
        const auto start = Clock::now();
        const int draws_before = passes.draws();
        const AxisLayers layers = find_layers(target, axis, hits);
        report.layer_count[static_cast<int>(axis)] = layers.count;
        report.axis_complete[static_cast<int>(axis)] = layers.complete;
        report.layer_draws += passes.draws() - draws_before;
        report.layer_seconds += seconds_since(start);
        return !layers.stopped;
    }

    AxisLayers find_layers(const Target& target, Axis axis, const OuterHits& hits) {
        if (room_between(hits, options.n).empty()) return {};
        const LayerTask task{passes,
                             target,
                             report.box,
                             axis,
                             options.normals,
                             options.most_layers,
                             {options.both_sides, options.culls}};
        const auto layer_sink = [&](ViewImage&& image) {
            count(image);
            return send(std::move(image));
        };
        if (report.layer_method == LayerMethod::peel) {
            const AxisLayers layers = peel_axis(task, *shader, hits, layer_sink);
            if (layers.usable) return layers;
            report.layer_method = LayerMethod::slab;
        }
        return slab_axis(task, hits, layer_sink);
    }

    void choose_method() {
        report.layer_method = LayerMethod::slab;
        if (options.layer_method == LayerMethod::slab || !options.use_shaders) return;
        shader = PeelShader::make(gl, options.n);
        if (shader) report.layer_method = LayerMethod::peel;
    }

    void judge_layers() {
        const bool all =
            std::all_of(report.axis_complete.begin(), report.axis_complete.end(), [](bool b) { return b; });
        report.layers = all ? Layers::complete : Layers::incomplete;
    }

    void capture_view(const Target& target) {
        Pass pass;
        pass.box = report.box;
        pass.axis = image.view.axis;
        pass.side = image.view.side;
        pass.outermost = true;
        OpenTiles tiles(report.box, pass.axis, image.n);
        tiles.open_all();
        pass.open = &tiles;

        auto start = Clock::now();
        passes.run(pass, target);
        blend_coincident(passes, target, pass);
        report.colour_seconds += seconds_since(start);

        start = Clock::now();
        target.read_depth(image.depth);
        read_blended(target, image.colour, PixelRect::whole(image.n));
        mark_covered(image);
        report.read_seconds += seconds_since(start);

        start = Clock::now();
        pass.only =
            bounds_of(PixelRect::whole(image.n), image.n, [&](std::size_t p) { return image.covered(p); });
        tiles.close_all();
        for_each_pixel(*pass.only, image.n, [&](std::size_t p) {
            if (image.covered(p)) tiles.open(p, image.depth[p], image.depth[p]);
        });
        image.normal.assign(image.depth.size(), glm::vec4(0));
        image.other_colour.clear(), image.other_normal.clear();
        if (!pass.only->empty()) {
            const SidesTask both{options.both_sides, options.culls};
            const SeenSides sides = see_sides(passes, target, pass, both, options.normals, image);
            capture_normals(passes, target, pass, options.normals, image);
            take_sides(sides, *pass.only, image);
        }
        report.normal_seconds += seconds_since(start);
        count(image);
    }

    /// The test lets nothing at background depth through, so depth alone says what is covered.
    static void mark_covered(ViewImage& image) {
        const float background = ViewImage::background(image.view.side);
        for (std::size_t i = 0; i < image.depth.size(); ++i)
            image.colour[i].a = image.depth[i] != background ? 1.0f : 0.0f;
    }

    void count(const ViewImage& image) {
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
            covered += image.covered(i);
            report.pixels_without_normal += image.covered(i) && image.normal[i].w == 0;
        }
    }

    const GlTable& gl;
    const EngineOptions& options;
    const ImageSink& sink;
    EngineReport& report;
    PassRunner passes;
    std::unique_ptr<PeelShader> shader;
    ViewImage image; ///< of the six views one after the other; memory that the sink leaves is used again
    long covered = 0;
};

} // namespace

EngineReport run_capture(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options,
                         const ImageSink& sink) {
    EngineReport report;
    try {
        const auto real = std::make_unique<GlTable>(with_framebuffer_calls(gl));
        Capture(*real, draw, options, sink, report).run();
    } catch (const std::bad_alloc&) {
        report.error = "out of memory";
    } catch (const std::exception& failure) {
        report.error = failure.what();
    } catch (...) {
        report.error = "the scene could not be drawn";
    }
    report.ok = report.error.empty();
    return report;
}

std::optional<Box> find_box(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options) {
    try {
        const auto real = std::make_unique<GlTable>(with_framebuffer_calls(gl));
        if (!obstacle(*real, options.n).empty()) return std::nullopt;
        PassRunner passes(*real, draw, options);
        return find_box_with(*real, passes, options);
    } catch (...) {
        return std::nullopt;
    }
}

bool can_make_target(const GlTable& gl) {
    constexpr int any_size = 8;
    const GlTable whole = with_framebuffer_calls(gl);
    return has_framebuffer_calls(whole) && Target(whole, any_size, false).complete();
}

} // namespace glcast
