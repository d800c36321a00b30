#include "shim/preload/capture_job.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "capture/output_name.h"
#include "capture/reference_views.h"
#include "shim/preload/masked_faces.h"
#include "shim/preload/status.h"

namespace glcast::preload {
namespace {

struct Facts {
    const Group& group;
    const Options& options;
    const StencilPlan& stencil;
    long cuts;   ///< draws that cut solids in the depth buffer
    long masked; ///< triangles that only hide what is behind them (masked_faces.h)
};

/// What is cast in another way than the program draws it.
struct Remark {
    const char* what; ///< in the capture file, and in the line "not understood"
    long (*draws)(const Facts&);
    const char* said = nullptr; ///< a line of its own
    bool (*is_said)(const Facts&) = [](const Facts&) { return true; };
};

constexpr Remark remarks[] = {
    {"a draw that cuts solids in the depth buffer: they are cast uncut",
     [](const Facts& f) { return f.cuts; },
     "solids that the program cuts out of one another as it draws them (OpenCSG) are cast uncut: let it "
     "cut them before, in OpenSCAD by render() in the script"},
    {"draws in clip coordinates, whose field of view nobody tells: 45 degrees guessed",
     [](const Facts& f) { return f.group.guessed_view ? f.group.draws : 0L; },
     "the program hands over clip coordinates, and nobody tells its field of view: 45 degrees guessed; "
     "--fov DEGREES tells it"},
    {"faces drawn into the depth buffer alone (hidden lines): in the colour of the background",
     [](const Facts& f) { return f.group.is_hidden_line() ? f.group.hidden_triangles : 0L; },
     "hidden-line drawing: its faces are cast in the colour of the background; --include lines casts "
     "its lines too",
     [](const Facts& f) { return f.group.lines > 0 && !f.options.include.lines; }},
    {"a draw blended by its colours alone: solid or not by its function as a whole",
     [](const Facts& f) {
         return f.options.transparent == Transparent::by_alpha ? f.group.judged_by_function : 0L;
     }},
    {"a draw that a stencil test keeps to places which other views cannot tell: cast whole",
     [](const Facts& f) { return f.stencil.unfollowed; }},
    {"a draw under a stencil test of which nobody could ask whether it is an outline or a decal (occlusion "
     "queries "
     "tell): cast as neither",
     [](const Facts& f) { return f.stencil.unanswered; }},
    {"triangles drawn into the depth buffer alone, beside others with colours: not cast",
     [](const Facts& f) { return f.masked; }},
    {"a draw of vertices with a w of their own and no projection: cast as it stands in the picture",
     [](const Facts& f) { return long(f.group.with_own_w); }},
};

} // namespace

CaptureJob::CaptureJob(FrameReplay& of, const Options& with, const CastWindow& in, long frame,
                       const CapturePlan& by)
    : replay(of), options(with), window(in), number(frame), plan(by), group(by.candidate.group) {}

CastResult CaptureJob::run() {
    tell("casting", std::to_string(number));
    const EngineOptions& engine = plan.options_of_engine();
    CaptureInfo info = make_info();
    info.not_understood = not_understood();
    const std::string path = output_name(options.out, getpid(), number);
    CastResult result = write(plan.solid(engine), info, engine, path);
    if (result.outcome == CastOutcome::captured && options.reference_views > 0)
        result = write_references(info, path, std::move(result));
    if (result.outcome != CastOutcome::captured) return result;
    tell(window.replaces ? "recaptured" : "captured", std::to_string(number) + " " + path);
    if (!window.name.empty()) result.message += " of " + window.name;
    return result;
}

std::map<std::string, long> CaptureJob::not_understood() const {
    std::map<std::string, long> all = replay.not_understood(plan.candidate);
    const Facts facts{group, options, plan.stencil_plan(), cutting_draws(replay.all_scenes(), group),
                      masked_beside(replay.gl, replay.parts_of(plan.candidate), group)};
    for (const Remark& remark : remarks) {
        const long draws = remark.draws(facts);
        if (draws == 0) continue;
        all[remark.what] = draws;
        if (remark.said && remark.is_said(facts)) say_once("%s", remark.said);
    }
    for (const auto& [what, times] : all)
        say_once("not understood: %s (%ld in this frame)", what.c_str(), times);
    if (window.unanswered > 0)
        all["questions about windows that the X server did not answer in time"] = window.unanswered;
    if (window.unseen > 0) {
        all["later frames, too fast to be recorded before their time: the window may show another picture"] =
            window.unseen;
        say_once(
            "frame %ld is cast, the last with solid geometry that was recorded: %ld came after it too fast "
            "to be recorded before their time, and the window may show another picture",
            number, window.unseen);
    }
    return all;
}

CaptureInfo CaptureJob::make_info() const {
    const EngineOptions& engine = plan.options_of_engine();
    CaptureInfo info;
    info.n = engine.n;
    info.box = *engine.box;
    info.eye_to_capture = engine.eye_to_capture;
    info.program = program_name();
    info.frame = number;
    const GLubyte* renderer = replay.gl.GetString(GL_RENDERER);
    info.renderer = renderer ? reinterpret_cast<const char*>(renderer) : "";
    info.normals = options.normals == NormalMethod::six_lights ? "six" : "signed";
    info.glcast_version = GLCAST_VERSION;
    info.both_sides = engine.both_sides;
    info.reversed_backs = plan.sides().are_reversed();
    info.seen_places = plan.seen_places();
    if (group.kind == ProjectionKind::perspective) info.eye = eye_of(group, engine.eye_to_capture);
    return info;
}

/// Engine to file, image by image.
CastResult CaptureJob::write(const DrawFunction& draw, const CaptureInfo& info, const EngineOptions& engine,
                             const std::string& path) const {
    const int most_parts = 3 * (1 + engine.most_layers);
    const auto start = std::chrono::steady_clock::now();
    CaptureWriter writer(path, info, most_parts);
    if (!writer.error().empty()) return failure(writer.error());
    const EngineReport report = run_capture(replay.gl, draw, engine, [&](ViewImage&& image) {
        replay.patience.image_is_done(image.view);
        return writer.add(image);
    });
    if (!writer.error().empty()) return failure(writer.error());
    if (!report.ok) return failure(report.error);
    if (!writer.finish(report.layers, report.layer_method)) return failure(writer.error());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    char text[200];
    std::snprintf(text, sizeof text, "(n=%d, box %.6g wide, layers %d %d %d %s, %d draws, %.2f s)", info.n,
                  info.box.size, report.layer_count[0], report.layer_count[1], report.layer_count[2],
                  layers_name(report.layers), report.draws, seconds.count());
    tell("figures", text);
    return {CastOutcome::captured, "captured frame " + std::to_string(info.frame) + " of " + info.program +
                                       ": " + path + " " + text};
}

/// The same frame from sides that the capture has not, beside it; `captured` when all are written.
CastResult CaptureJob::write_references(CaptureInfo info, const std::string& path,
                                        CastResult captured) const {
    const EngineOptions& captured_with = plan.options_of_engine();
    int count = 0;
    for (const glm::dmat4& rotation : reference_rotations(options.reference_views)) {
        EngineOptions engine = captured_with;
        engine.most_layers = 1;
        if (options.reference_n > 0) info.n = engine.n = options.reference_n;
        engine.eye_to_capture = rotation * captured_with.eye_to_capture;
        engine.search = turned_box(*captured_with.box, rotation);
        const DrawFunction draw = plan.solid(engine);
        engine.box = find_box(replay.gl, draw, engine);
        if (!engine.box) return failure("a reference view shows nothing");
        info.box = *engine.box;
        info.eye_to_capture = engine.eye_to_capture;
        info.from_capture = rotation;
        info.eye.reset();
        info.seen_places.clear();
        CastResult result = write(draw, info, engine, reference_name(path, ++count));
        if (result.outcome != CastOutcome::captured) return result;
    }
    return captured;
}

} // namespace glcast::preload
