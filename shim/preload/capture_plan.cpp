#include "shim/preload/capture_plan.h"

#include <algorithm>
#include <memory>

#include "shim/preload/axes.h"
#include "shim/preload/left_out.h"
#include "shim/preload/seen_through.h"
#include "shim/preload/status.h"
#include "shim/preload/stencil_judge.h"
#include "shim/preload/strokes.h"

namespace glcast::preload {
namespace {

/// How far away the far plane may be, in near planes, when the search for the object begins: a far plane at
/// infinity would make everything smaller than a pixel. The first that finds something is taken.
constexpr double far_ratios[] = {100, 3'000, 1e6};

} // namespace

CapturePlan::CapturePlan(FrameReplay& of, const Options& with, const Candidate& what)
    : candidate(what), replay(of), options(with) {
    replay.enter_for(candidate);
    engine = start_options();
    follow_stencil();
    look_at_sides();
    const DrawFunction as_drawn = drawing({.lines = options.include.lines, .points = options.include.points});
    engine.box = options.box ? options.box : find_scene_box(as_drawn);
    if (engine.box) places = look_through(as_drawn);
}

EngineOptions CapturePlan::start_options() const {
    const Group& group = candidate.group;
    EngineOptions start;
    start.n = options.n;
    start.normals = options.normals;
    start.most_layers = options.most_layers;
    start.layer_method = options.layer_method;
    start.use_shaders = options.use_shaders;
    start.mirrored_projection = group.is_mirrored();
    start.eye_to_capture =
        choose_eye_to_capture({group.base_modelview, group.is_mirrored() != group.turned_round}, options);
    return start;
}

/// Where fronts and backs are told apart, both are cast.
void CapturePlan::look_at_sides() {
    for (const ScenePart& part : replay.parts_of(candidate)) both.add(sides_of(part.scene, part.group));
    engine.both_sides = both.are_apart(), engine.culls = both.culled;
}

/// What the draws have to do with the stencil buffer, where some are kept to places by it.
void CapturePlan::follow_stencil() {
    if (!replay.gl.WindowPos2i || cutting_draws(replay.all_scenes(), candidate.group) > 0) return;
    for (const ScenePart& part : replay.parts_of(candidate)) {
        StencilPlan of = plan_stencil(part.scene, part.group);
        judge(replay.gl, part.frame, part.scene, part.group, of);
        plan.kept += of.kept, plan.unfollowed += of.unfollowed, plan.unanswered += of.unanswered;
    }
    engine.stencil = plan.kept > 0 ? &stencil : nullptr;
}

std::optional<Box> CapturePlan::find_scene_box(const DrawFunction& draw) const {
    EngineOptions searching = engine;
    for (const double far_ratio : far_ratios) {
        const auto search = view_volume(candidate.group, engine.eye_to_capture, far_ratio);
        if (search) searching.search = *search;
        if (const auto box = find_box(replay.gl, draw, searching)) return box;
        if (!search || candidate.group.kind != ProjectionKind::perspective) break;
    }
    return std::nullopt;
}

/// Leaves backdrops and outlines out, and finds the box anew. Places that are seen through culled faces.
std::vector<glm::dvec3> CapturePlan::look_through(const DrawFunction& as_drawn) {
    const std::vector<ScenePart> of = replay.parts_of(candidate);
    const auto see = [&] { return see_through(replay.gl, drawing({}), candidate.group, engine); };
    SeenThrough seen;
    if (of.size() == 1 && !engine.stencil && may_see_through(of[0].scene, of[0].group)) seen = see();
    if (options.keep_backdrops) return seen.places;
    const bool both_turns = std::any_of(
        of.begin(), of.end(), [](const ScenePart& part) { return shows_both_turns(part.scene, part.group); });
    // A box that is asked for holds what is wanted.
    const bool looks = !options.box && may_have_backdrops(of, engine, candidate.picture.coverage);
    const LeftOut left =
        leave_out(of, replay.gl, engine, {.backdrops = looks, .outlines = seen.any || both_turns});
    if (!left.lines.empty()) say_once("%s", left.lines.c_str());
    if (left.draws == 0) return seen.places;
    if (!options.box) engine.box = find_scene_box(as_drawn);
    return seen.any && engine.box ? see().places : seen.places;
}

bool CapturePlan::would_show_blended() {
    if (options.transparent != Transparent::by_alpha) return false;
    Wanted wanted{.backdrops = options.keep_backdrops, .transparent = Transparent::keep};
    wanted.stencil = engine.stencil;
    return find_scene_box(replay.drawing(candidate, wanted)).has_value();
}

DrawFunction CapturePlan::drawing(Wanted wanted) const {
    wanted.transparent = options.transparent;
    wanted.stencil = engine.stencil;
    wanted.backdrops = options.keep_backdrops;
    return replay.drawing(candidate, wanted);
}

DrawFunction CapturePlan::solid(const EngineOptions& with) const {
    return options.include.any() ? thickened(with) : drawing({});
}

/// Lines and points a sample and a half wide: what is thinner than a sample falls between the rays.
DrawFunction CapturePlan::thickened(const EngineOptions& with) const {
    const Wanted thin{.solid = false, .lines = options.include.lines, .points = options.include.points};
    const auto strokes =
        std::make_shared<const std::vector<Stroke>>(collect_strokes(replay.gl, drawing(thin), with));
    const double half_width = 0.75 * with.box->size / with.n;
    const glm::dmat4 eye_to_capture = with.eye_to_capture;
    return [=, solid = drawing({})](const GlTable& table, const Sought& sought) {
        solid(table, sought);
        draw_strokes(*strokes, half_width, eye_to_capture, table);
    };
}

} // namespace glcast::preload
