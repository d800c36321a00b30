#include "capture/engine.h"

#include <chrono>
#include <exception>
#include <glm/glm.hpp>
#include <memory>

#include "capture/engine_box.h"
#include "capture/engine_normal.h"
#include "capture/engine_pass.h"
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
        for (Axis axis : {Axis::x, Axis::y, Axis::z}) {
            for (Side side : {Side::minus, Side::plus}) {
                ViewImage image;
                image.view = {axis, side, 0};
                image.n = options.n;
                capture_view(target, image);
                if (sink(std::move(image))) continue;
                report.error = "stopped by the receiver of the images";
                return;
            }
        }
        if (covered == 0) report.error = "nothing solid was drawn";
    }

    void capture_view(const Target& target, ViewImage& image) {
        Pass pass;
        pass.box = report.box;
        pass.axis = image.view.axis;
        pass.side = image.view.side;

        auto start = Clock::now();
        passes.run(pass, target);
        report.colour_seconds += seconds_since(start);

        start = Clock::now();
        target.read_depth(image.depth);
        target.read_colour(image.colour);
        mark_covered(image);
        report.read_seconds += seconds_since(start);

        start = Clock::now();
        capture_normals(passes, target, pass, options.normals, image);
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

} // namespace glcast
