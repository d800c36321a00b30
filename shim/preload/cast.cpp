#include "shim/preload/cast.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "capture/capture_file.h"
#include "shim/preload/output_name.h"
#include "shim/preload/real.h"
#include "shim/preload/scene.h"
#include "shim/preload/session.h"
#include "shim/preload/similarity.h"
#include "shim/preload/status.h"

namespace glcast::preload {
namespace {

/// How far away the far plane may be, in near planes, when the search for the object begins: a far plane at
/// infinity would make everything smaller than a pixel. The first that finds something is taken.
constexpr double far_ratios[] = {100, 3'000, 1e6};

/// A context of ours current with the program's drawables, and the program's own again at the end.
class SiblingScope {
  public:
    explicit SiblingScope(NativeContext& of) : context(of), program(of.system->current()) {
        if (!context.system->can_return_to(program))
            throw std::runtime_error("the program has destroyed its drawable");
        if (!context.sibling) context.sibling = context.make_sibling();
        if (!context.sibling) throw std::runtime_error("no second context can be made beside the program's");
        Binding binding = program;
        binding.context = context.sibling;
        if (context.system->bind(binding)) return;
        restore();
        throw std::runtime_error("the second context cannot be made current");
    }
    ~SiblingScope() { restore(); }
    SiblingScope(const SiblingScope&) = delete;
    SiblingScope& operator=(const SiblingScope&) = delete;

  private:
    void restore() {
        if (!context.system->bind(program)) say_once("the program's context could not be made current again");
    }
    NativeContext& context;
    const Binding program;
};

CastResult failure(const std::string& why) { return {CastOutcome::failed, "nothing captured: " + why}; }

/// The group that is asked for; -1 when the frame has none.
int choose_group(const Scene& scene, int asked) {
    if (scene.groups.empty()) return -1;
    const int index = asked > 0 ? asked - 1 : 0;
    if (index >= static_cast<int>(scene.groups.size())) return -1;
    const Group& group = scene.groups[index];
    const bool solid = asked > 0 ? group.triangles + group.outlined > 0 : group.is_scene();
    return solid ? index : -1;
}

glm::dmat4 choose_eye_to_capture(const Scene& scene, const Options& options) {
    if (options.frame_matrix == FrameMatrix::given) return options.given_matrix;
    if (options.frame_matrix == FrameMatrix::eye || !scene.base_modelview) return glm::dmat4(1.0);
    if (is_similarity(*scene.base_modelview)) return glm::inverse(*scene.base_modelview);
    if (options.frame_matrix == FrameMatrix::base)
        throw std::runtime_error("the base modelview is no similarity (--frame-matrix base)");
    return glm::dmat4(1.0);
}

CastResult list_groups(const Scene& scene, long number) {
    for (std::size_t i = 0; i < scene.groups.size(); ++i) {
        const std::string text = std::to_string(i + 1) + " " + describe(scene.groups[i]);
        say("group %s", text.c_str());
        tell("group", text);
    }
    tell("listed", std::to_string(number));
    return {CastOutcome::listed, "listed frame " + std::to_string(number)};
}

std::optional<Box> find_scene_box(const GlTable& gl, const DrawFunction& draw, const Group& group,
                                  EngineOptions options) {
    for (const double far_ratio : far_ratios) {
        const auto search = view_volume(group, options.eye_to_capture, far_ratio);
        if (search) options.search = *search;
        if (const auto box = find_box(gl, draw, options)) return box;
        if (!search || group.kind != ProjectionKind::perspective) break;
    }
    return std::nullopt;
}

CaptureInfo make_info(const record::Frame& frame, long number, const Options& options,
                      const EngineOptions& engine, const GlTable& gl) {
    CaptureInfo info;
    info.n = engine.n;
    info.box = *engine.box;
    info.eye_to_capture = engine.eye_to_capture;
    info.program = program_name();
    info.frame = number;
    const GLubyte* renderer = gl.GetString(GL_RENDERER);
    info.renderer = renderer ? reinterpret_cast<const char*>(renderer) : "";
    info.normals = options.normals == NormalMethod::six_lights ? "six" : "signed";
    info.glcast_version = GLCAST_VERSION;
    info.not_understood = record::not_understood(frame);
    return info;
}

void tell_not_understood(const record::Frame& frame) {
    for (const auto& [what, times] : record::not_understood(frame))
        say_once("not understood: %s (%ld in this frame)", what.c_str(), times);
}

/// Engine to file, image by image.
CastResult write_capture(const GlTable& gl, const DrawFunction& draw, const CaptureInfo& info,
                         const EngineOptions& engine, const std::string& path) {
    const int most_parts = 3 * (1 + engine.most_layers);
    const auto start = std::chrono::steady_clock::now();
    CaptureWriter writer(path, info, most_parts);
    if (!writer.error().empty()) return failure(writer.error());
    const EngineReport report =
        run_capture(gl, draw, engine, [&](ViewImage&& image) { return writer.add(std::move(image)); });
    if (!writer.error().empty()) return failure(writer.error());
    if (!report.ok) return failure(report.error);
    if (!writer.finish(report.layers, report.layer_method)) return failure(writer.error());
    tell("captured", std::to_string(info.frame) + " " + path);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    char text[200];
    std::snprintf(text, sizeof text, "(n=%d, box %.6g wide, layers %d %d %d %s, %d draws, %.2f s)", info.n,
                  info.box.size, report.layer_count[0], report.layer_count[1], report.layer_count[2],
                  layers_name(report.layers), report.draws, seconds.count());
    return {CastOutcome::captured, "captured frame " + std::to_string(info.frame) + " of " + info.program +
                                       ": " + path + " " + text};
}

CastResult cast_in_sibling(const record::Frame& frame, long number, const Options& options) {
    const GlTable& gl = real_table();
    const Scene scene = analyse(frame, gl);
    const int group = choose_group(scene, options.group);
    if (group < 0) return {CastOutcome::nothing_solid, ""};
    if (options.list) return list_groups(scene, number);

    const DrawFunction draw = [&](const GlTable& table) { replay_group(frame, scene, group, table); };
    EngineOptions engine;
    engine.n = options.n;
    engine.normals = options.normals;
    engine.most_layers = options.most_layers;
    engine.layer_method = options.layer_method;
    engine.use_shaders = options.use_shaders;
    engine.eye_to_capture = choose_eye_to_capture(scene, options);
    engine.box = options.box ? options.box : find_scene_box(gl, draw, scene.groups[group], engine);
    if (!engine.box) return {CastOutcome::nothing_solid, ""};
    tell("casting", std::to_string(number));
    tell_not_understood(frame);
    return write_capture(gl, draw, make_info(frame, number, options, engine, gl), engine,
                         output_name(options.out, getpid(), number));
}

} // namespace

CastResult cast_frame(NativeContext& context, const record::Frame& frame, long number,
                      const Options& options) {
    try {
        const SiblingScope sibling(context);
        return cast_in_sibling(frame, number, options);
    } catch (const std::exception& error) {
        return failure(error.what());
    }
}

} // namespace glcast::preload
