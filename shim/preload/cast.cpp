#include "shim/preload/cast.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <stdexcept>

#include "capture/capture_file.h"
#include "capture/output_name.h"
#include "capture/reference_views.h"
#include "shim/preload/axes.h"
#include "shim/preload/choice.h"
#include "shim/preload/contact_sheet.h"
#include "shim/preload/left_out.h"
#include "shim/preload/mask.h"
#include "shim/preload/patience.h"
#include "shim/preload/real.h"
#include "shim/preload/seen_through.h"
#include "shim/preload/session.h"
#include "shim/preload/sibling_scope.h"
#include "shim/preload/status.h"
#include "shim/preload/stencil_judge.h"
#include "shim/preload/stencil_plan.h"
#include "shim/preload/strokes.h"

namespace glcast::preload {
namespace {

/// How far away the far plane may be, in near planes, when the search for the object begins: a far plane at
/// infinity would make everything smaller than a pixel. The first that finds something is taken.
constexpr double far_ratios[] = {100, 3'000, 1e6};

/// glcast-run says itself what is told.
PatienceLines patience_lines() {
    return {.slow =
                [](const std::string& text) {
                    tell("slow", text);
                    if (!has_status_file()) say("%s", text.c_str());
                },
            .progress = [](const std::string& text) { tell("progress", text); }};
}

CastResult failure(const std::string& why) { return {CastOutcome::failed, "nothing captured: " + why}; }

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

CaptureInfo make_info(long number, const Options& options, const EngineOptions& engine, const GlTable& gl) {
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
    info.both_sides = engine.both_sides;
    return info;
}

/// Engine to file, image by image.
CastResult write_capture(const GlTable& gl, const DrawFunction& draw, const CaptureInfo& info,
                         const EngineOptions& engine, const std::string& path, Patience& patience) {
    const int most_parts = 3 * (1 + engine.most_layers);
    const auto start = std::chrono::steady_clock::now();
    CaptureWriter writer(path, info, most_parts);
    if (!writer.error().empty()) return failure(writer.error());
    const EngineReport report = run_capture(gl, draw, engine, [&](ViewImage&& image) {
        patience.image_is_done(image.view);
        return writer.add(std::move(image));
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

/// A frame in the making of its capture.
class Cast {
  public:
    Cast(const std::vector<FramePart>& frame_parts, long frame_number, const Options& of,
         const CastWindow& in)
        : parts(frame_parts), number(frame_number), options(of), window(in),
          gl(masked_table(real_table(), of.mask)), siblings(*frame_parts.front().context) {}

    /// Textures that replays have made lie in the program's share group.
    ~Cast() {
        try {
            for (const FramePart& part : parts) {
                const bool has_copies = record::has_copies(*part.frame);
                if (has_copies || has_only_looked) siblings.enter(part);
                if (has_copies) record::delete_copies(*part.frame, gl);
                if (has_only_looked) record::let_go(*part.frame, gl);
            }
            if (has_only_looked) siblings.keep();
        } catch (const std::exception&) {
            say_once("copies of textures could not be deleted");
        }
    }
    Cast(const Cast&) = delete;
    Cast& operator=(const Cast&) = delete;

    CastResult run(std::vector<Candidate>& listed) {
        CastResult result = look_and_cast(listed);
        has_only_looked = result.outcome == CastOutcome::nothing_solid && !has_drawn;
        return result;
    }

  private:
    CastResult look_and_cast(std::vector<Candidate>& listed) {
        if (!draws_into_framebuffers()) return failure("this OpenGL has no framebuffer objects to draw into");
        for (const FramePart& part : parts) {
            if (options.prepare_replay) record::prepare(*part.frame);
            siblings.enter(part);
            scenes.push_back(analyse(*part.frame, gl, options.view_angle));
        }
        candidates = merge(scenes, [&](int a, int b) {
            return record::share_objects(*parts[a].context->shadow, *parts[b].context->shadow);
        });
        if (candidates.empty()) return nothing_solid();
        rank(candidates, options.include, !options.list_picture.empty(),
             [&](const Candidate& candidate) { return picture_of(candidate); });
        const bool has_scene = is_scene(candidates.front());
        if (!has_scene && options.group == 0) return nothing_solid();
        if (options.list) return list_groups(listed);
        if (options.group > static_cast<int>(candidates.size()))
            return has_scene ? no_such_group() : nothing_solid();
        const Candidate& best = candidates[options.group > 0 ? options.group - 1 : 0];
        const Rating rating{best, substance(best.group, options.include)};
        if (window.to_beat && !better(rating, *window.to_beat))
            return {CastOutcome::not_better, "", {}, rating};
        CastResult result = cast(best);
        if (result.outcome == CastOutcome::captured) result.rating = rating;
        return result;
    }

    const std::vector<FramePart>& parts;
    const long number;
    const Options& options;
    const CastWindow& window;
    const GlTable& gl;
    SiblingScope siblings;
    std::vector<Scene> scenes;
    std::vector<Candidate> candidates;
    mutable Patience patience{options.most_seconds, patience_lines()};
    bool has_drawn = false, has_only_looked = false;
    mutable ProgramStencil stencil;
    StencilPlan stencil_plan;

    /// Asked of GL itself: glvnd has the entry points in any case.
    bool draws_into_framebuffers() {
        siblings.enter(parts.front());
        return can_make_target(gl);
    }

    void enter_for(const Candidate& candidate) {
        for (std::size_t part = 0; part < parts.size(); ++part)
            if (candidate.in_part[part] >= 0) return siblings.enter(parts[part]);
    }

    DrawFunction drawing(const Candidate& candidate, Wanted wanted) const {
        return drawing(candidate, wanted, options.transparent);
    }
    DrawFunction drawing(const Candidate& candidate, Wanted wanted, Transparent transparent) const {
        wanted.transparent = transparent;
        wanted.stencil = stencil_plan.kept > 0 ? &stencil : nullptr;
        wanted.backdrops = options.keep_backdrops;
        const auto places = std::make_shared<std::vector<DrawPlaces>>(parts.size());
        return [this, &candidate, wanted, places](const GlTable& table, const Sought& sought) {
            if (!sought.only_places) patience.render_begins();
            for (std::size_t part = 0; part < parts.size(); ++part)
                if (candidate.in_part[part] >= 0)
                    replay_group(*parts[part].frame, scenes[part], candidate.in_part[part], wanted, table,
                                 sought, &(*places)[part]);
        };
    }

    Thumbnail picture_of(const Candidate& candidate) {
        has_drawn = true;
        enter_for(candidate);
        constexpr int size = 192;
        const Group& group = candidate.group;
        return draw_thumbnail(gl, drawing(candidate, {.everything = true}), group.viewport,
                              group.depth_reversed, size);
    }

    CastResult nothing_solid() const {
        CastResult result{CastOutcome::nothing_solid, ""};
        for (const Candidate& c : candidates) {
            (is_scene(c) ? result.held.solid : result.held.flat) += c.group.triangles + c.group.outlined;
            if (is_scene(c)) result.held.masked += c.group.hidden_triangles;
            result.held.lines += c.group.lines;
            result.held.points += c.group.points;
        }
        for (const Scene& scene : scenes) result.held.pixels += scene.pixels;
        for (const FramePart& part : parts)
            for (const auto& [what, times] : record::not_understood(*part.frame))
                if (what.starts_with("a draw under")) result.held.shaders += times;
        if (!candidates.empty() && options.group > static_cast<int>(candidates.size()))
            result.held.no_such_group = groups_instead();
        return result;
    }

    /// In one line that --group cannot be followed, and what there is.
    std::string groups_instead() const {
        constexpr std::size_t most = 6;
        const std::size_t count = candidates.size();
        std::string text = "there is no group " + std::to_string(options.group) + ", the frame has " +
                           std::to_string(count) + (count == 1 ? " group" : " groups");
        for (std::size_t i = 0; i < std::min(count, most); ++i)
            text += (i == 0 ? ": " : "; ") + std::to_string(i + 1) + " " + describe(candidates[i].group);
        return text + (count > most ? "; ... (--list shows all)" : "");
    }

    CastResult no_such_group() const { return failure(groups_instead()); }

    CastResult list_groups(std::vector<Candidate>& listed) {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            Candidate& c = candidates[i];
            c.number = static_cast<int>(i) + 1;
            c.window = window.name;
            const std::string text = std::to_string(c.number) + " " + describe(c.group) +
                                     (c.backdrop ? ", a backdrop"
                                      : c.inset  ? ", an inset"
                                                 : "") +
                                     (c.window.empty() ? "" : ", " + c.window);
            if (speaks_alone()) say("group %s", text.c_str());
            tell("group", text);
        }
        if (!options.list_picture.empty()) {
            listed.insert(listed.end(), candidates.begin(), candidates.end());
            const std::string trouble = write_contact_sheet(listed, options.list_picture);
            if (!trouble.empty()) return failure(trouble);
        }
        tell("listed", std::to_string(number));
        const Candidate& best = candidates.front();
        return {CastOutcome::listed,
                "listed frame " + std::to_string(number),
                {},
                Rating{best, substance(best.group, options.include)}};
    }

    CastResult cast(const Candidate& candidate) {
        has_drawn = true;
        enter_for(candidate);
        const Group& group = candidate.group;
        EngineOptions engine;
        engine.n = options.n;
        engine.normals = options.normals;
        engine.most_layers = options.most_layers;
        engine.layer_method = options.layer_method;
        engine.use_shaders = options.use_shaders;
        engine.mirrored_projection = group.is_mirrored();
        engine.eye_to_capture =
            choose_eye_to_capture({group.base_modelview, group.is_mirrored() != group.turned_round}, options);
        engine.stencil = follow_stencil(candidate);
        for (std::size_t part = 0; part < parts.size(); ++part) {
            if (candidate.in_part[part] < 0) continue;
            const Sides sides = sides_of(scenes[part], candidate.in_part[part]);
            engine.both_sides |= sides.apart, engine.culls |= sides.culled;
        }
        const Include& include = options.include;
        const DrawFunction as_drawn = drawing(candidate, {.lines = include.lines, .points = include.points});
        engine.box = options.box ? options.box : find_scene_box(gl, as_drawn, group, engine);
        std::vector<glm::dvec3> seen_places;
        if (engine.box) seen_places = look_through(candidate, as_drawn, engine);
        if (!engine.box && !patience.over().empty()) return failure(patience.over());
        if (!engine.box) {
            CastResult nothing = nothing_solid();
            if (shows_when_kept(candidate, engine)) nothing.held.see_through = nothing.held.solid;
            return nothing;
        }
        tell("casting", std::to_string(number));
        return write(candidate, engine, seen_places);
    }

    /// What the draws have to do with the stencil buffer, where some are kept to places by it; else null.
    ProgramStencil* follow_stencil(const Candidate& candidate) {
        stencil_plan = {};
        if (!gl.WindowPos2i || cutting_draws(scenes, candidate.group) > 0) return nullptr;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            if (candidate.in_part[part] < 0) continue;
            const int group = candidate.in_part[part];
            StencilPlan plan = plan_stencil(scenes[part], group);
            judge(gl, *parts[part].frame, scenes[part], group, plan);
            stencil_plan.kept += plan.kept, stencil_plan.unfollowed += plan.unfollowed;
        }
        return stencil_plan.kept > 0 ? &stencil : nullptr;
    }

    /// Leaves backdrops and outlines out, and finds the box anew. Places that are seen through culled faces.
    std::vector<glm::dvec3> look_through(const Candidate& candidate, const DrawFunction& as_drawn,
                                         EngineOptions& engine) {
        std::vector<ScenePart> of;
        for (std::size_t part = 0; part < parts.size(); ++part)
            if (candidate.in_part[part] >= 0)
                of.push_back({*parts[part].frame, scenes[part], candidate.in_part[part]});
        const auto see = [&] { return see_through(gl, drawing(candidate, {}), candidate.group, engine); };
        SeenThrough seen;
        if (of.size() == 1 && !engine.stencil && may_see_through(of[0].scene, of[0].group)) seen = see();
        if (options.keep_backdrops) return seen.places;
        const bool both_turns = std::any_of(of.begin(), of.end(), [](const ScenePart& part) {
            return shows_both_turns(part.scene, part.group);
        });
        // A box that is asked for holds what is wanted.
        const bool looks = !options.box && may_have_backdrops(of, engine, candidate.picture.coverage);
        const LeftOut left =
            leave_out(of, gl, engine, {.backdrops = looks, .outlines = seen.any || both_turns});
        if (!left.lines.empty()) say_once("%s", left.lines.c_str());
        if (left.draws == 0) return seen.places;
        if (!options.box) engine.box = find_scene_box(gl, as_drawn, candidate.group, engine);
        return seen.any && engine.box ? see().places : seen.places;
    }

    /// It is all see-through, or what is solid of it is nothing.
    bool shows_when_kept(const Candidate& candidate, const EngineOptions& engine) {
        if (options.transparent != Transparent::by_alpha) return false;
        return find_scene_box(gl, drawing(candidate, {}, Transparent::keep), candidate.group, engine)
            .has_value();
    }

    /// What is cast, through a capture frame.
    DrawFunction solid(const Candidate& candidate, const EngineOptions& engine) const {
        return options.include.any() ? thickened(candidate, engine) : drawing(candidate, {});
    }

    /// Lines and points a sample and a half wide: what is thinner than a sample falls between the rays.
    DrawFunction thickened(const Candidate& candidate, const EngineOptions& engine) const {
        const Include& include = options.include;
        const Wanted thin{.solid = false, .lines = include.lines, .points = include.points};
        const auto strokes = std::make_shared<const std::vector<Stroke>>(
            collect_strokes(gl, drawing(candidate, thin), engine));
        const double half_width = 0.75 * engine.box->size / engine.n;
        return [=, solid = drawing(candidate, {})](const GlTable& table, const Sought& sought) {
            solid(table, sought);
            draw_strokes(*strokes, half_width, engine.eye_to_capture, table);
        };
    }

    CastResult write(const Candidate& candidate, const EngineOptions& engine,
                     const std::vector<glm::dvec3>& seen_places) const {
        std::map<std::string, long> not_understood;
        for (std::size_t part = 0; part < parts.size(); ++part)
            if (candidate.in_part[part] >= 0)
                for (const auto& [what, times] : record::not_understood(*parts[part].frame))
                    not_understood[what] += times;
        if (const long cuts = cutting_draws(scenes, candidate.group)) {
            not_understood["a draw that cuts solids in the depth buffer: they are cast uncut"] = cuts;
            say_once("solids that the program cuts out of one another as it draws them (OpenCSG) are cast "
                     "uncut: let it "
                     "cut them before, in OpenSCAD by render() in the script");
        }
        const Group& group = candidate.group;
        if (group.guessed_view) {
            not_understood
                ["draws in clip coordinates, whose field of view nobody tells: 45 degrees guessed"] =
                    group.draws;
            say_once("the program hands over clip coordinates, and nobody tells its field of view: 45 "
                     "degrees guessed; "
                     "--fov DEGREES tells it");
        }
        if (group.is_hidden_line()) {
            not_understood
                ["faces drawn into the depth buffer alone (hidden lines): in the colour of the background"] =
                    group.hidden_triangles;
            if (group.lines > 0 && !options.include.lines)
                say_once("hidden-line drawing: its faces are cast in the colour of the background; --include "
                         "lines casts "
                         "its lines too");
        }
        if (group.judged_by_function && options.transparent == Transparent::by_alpha)
            not_understood["a draw blended by its colours alone: solid or not by its function as a whole"] =
                group.judged_by_function;
        if (stencil_plan.unfollowed > 0)
            not_understood
                ["a draw that a stencil test keeps to places which other views cannot tell: cast whole"] =
                    stencil_plan.unfollowed;
        if (group.with_own_w)
            not_understood["a draw of vertices with a w of their own and no projection: cast as it stands in "
                           "the picture"] = group.with_own_w;
        for (const auto& [what, times] : not_understood)
            say_once("not understood: %s (%ld in this frame)", what.c_str(), times);
        if (window.unanswered > 0)
            not_understood["questions about windows that the X server did not answer in time"] =
                window.unanswered;
        CaptureInfo info = make_info(number, options, engine, gl);
        info.seen_places = seen_places;
        if (group.kind == ProjectionKind::perspective) info.eye = eye_of(group, engine.eye_to_capture);
        info.not_understood = std::move(not_understood);
        const std::string path = output_name(options.out, getpid(), number);
        CastResult result = write_capture(gl, solid(candidate, engine), info, engine, path, patience);
        if (result.outcome != CastOutcome::captured) return result;
        if (options.reference_views > 0)
            result = write_references(candidate, info, engine, path, std::move(result));
        if (result.outcome != CastOutcome::captured) return result;
        tell(window.replaces ? "recaptured" : "captured", std::to_string(number) + " " + path);
        if (!window.name.empty()) result.message += " of " + window.name;
        return result;
    }

    /// The same frame from sides that the capture has not, beside it; `captured` when all are written.
    CastResult write_references(const Candidate& candidate, CaptureInfo info,
                                const EngineOptions& captured_with, const std::string& path,
                                CastResult captured) const {
        int count = 0;
        for (const glm::dmat4& rotation : reference_rotations(options.reference_views)) {
            EngineOptions engine = captured_with;
            engine.most_layers = 1;
            if (options.reference_n > 0) info.n = engine.n = options.reference_n;
            engine.eye_to_capture = rotation * captured_with.eye_to_capture;
            engine.search = turned_box(*captured_with.box, rotation);
            const DrawFunction draw = solid(candidate, engine);
            engine.box = find_box(gl, draw, engine);
            if (!engine.box) return failure("a reference view shows nothing");
            info.box = *engine.box;
            info.eye_to_capture = engine.eye_to_capture;
            info.from_capture = rotation;
            info.eye.reset();
            info.seen_places.clear();
            const CastResult result =
                write_capture(gl, draw, info, engine, reference_name(path, ++count), patience);
            if (result.outcome != CastOutcome::captured) return result;
        }
        return captured;
    }
};

} // namespace

CastResult cast_frame(const std::vector<FramePart>& parts, long number, const Options& options,
                      const CastWindow& window, std::vector<Candidate>& listed) {
    try {
        return Cast(parts, number, options, window).run(listed);
    } catch (const std::exception& error) {
        return failure(error.what());
    }
}

} // namespace glcast::preload
