#include "shim/preload/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <set>
#include <utility>

#include "shim/preload/eye_space.h"
#include "shim/preload/hidden_faces.h"
#include "shim/preload/scene_table.h"
#include "shim/record/context.h"

namespace glcast::preload {
namespace {

/// What is drawn over a surface without a depth test is nearer than it, as by glPolygonOffset.
constexpr double decal_nudge = 1.0 / 1024;

/// Lets through the draws of one group that are asked for.
class GroupFilter final : public DrawGate {
  public:
    GroupFilter(const GlTable& gl, const Scene& of, int index, const Wanted& what, const Sought& sought_for,
                DrawPlaces* all_places)
        : DrawGate(gl), scene(of), group(index), wanted(what), sought(sought_for), places(all_places) {
        // Passes that find marks of the stencil test look for all.
        if (!sought.open && !sought.corners && !sought.outline && !sought.notes_places) places = nullptr;
        if (places) places->begin(sought.eye_to_capture);
    }

    bool blends(bool on) override {
        blending = on;
        return wanted.transparent == Transparent::by_alpha;
    }
    bool blending_restored() override { return wanted.transparent != Transparent::by_alpha; }

    bool keep(GLenum mode, long) override {
        as_points = false;
        parts.reset();
        if (next >= scene.draws.size()) return false;
        const std::size_t number = next++;
        const Draw& draw = scene.draws[number];
        if (draw.group != group) return false;
        const bool skipped =
            (wanted.only && !(*wanted.only)[number]) || (wanted.transparent == Transparent::skip && blending);
        if (sought.only_places) {
            if (!skipped && wants(draw)) place_of(draw, mode);
            return false;
        }
        if (wanted.everything) return !skipped;
        const bool is_wanted = !skipped && wants(draw) && may_be_found(draw, mode);
        if (!(wanted.stencil ? wanted.stencil->begin_draw(draw.stencil, is_wanted) : is_wanted)) return false;
        if (wanted.marks) inner.PassThrough(-1 - static_cast<GLfloat>(number));
        const double nudge = draw.nudge - (draw.is_decal ? decal_nudge : 0);
        if (draw.eye_map >= 0 || nudge != 0)
            eye_space.enter(draw.eye_map >= 0 ? &scene.eye_maps[draw.eye_map] : nullptr, nudge);
        if (draw.hides && scene.groups[group].is_hidden_line())
            hidden_faces.enter(scene.groups[group].background);
        return true;
    }
    void drawn() override {
        hidden_faces.leave();
        eye_space.leave();
        if (wanted.stencil) wanted.stencil->end_draw();
    }
    void finish() {
        if (places) places->end();
    }
    bool draws_nothing() const override { return sought.only_places; }
    bool may_fix_colour() const override { return scene.groups[group].is_hidden_line(); }
    bool fixes_colour() const override { return hidden_faces.entered(); }

  private:
    bool wants(const Draw& draw) const {
        if (draw.kind == Draw::Kind::line) return wanted.lines;
        if (draw.kind == Draw::Kind::point) return wanted.points;
        return wanted.solid && is_solid(draw, scene.groups[group], wanted.backdrops);
    }

    /// Null where it is not known.
    const DrawPlace* place_of(const Draw& draw, GLenum mode) {
        const record::DrawParts* drawn = places && has_faces(mode) ? record::parts_of_draw() : nullptr;
        if (!drawn) return nullptr;
        return places->of(next - 1, [&] {
            glm::dmat4 to_eye(1.0);
            inner.GetDoublev(GL_MODELVIEW_MATRIX, glm::value_ptr(to_eye));
            if (draw.eye_map >= 0) to_eye = scene.eye_maps[draw.eye_map].apply(to_eye);
            return find_place(*drawn, to_eye, sought.eye_to_capture);
        });
    }

    /// Says, too, what is to be drawn of it, and how.
    bool may_be_found(const Draw& draw, GLenum mode) {
        const DrawPlace* place = place_of(draw, mode);
        if (!place || (sought.shows_all && draw.hides)) return true; // how it shows is set later
        as_points = sought.corners && place->is_whole && lies_inside(*place, *sought.corners) &&
                    points_are_the_same();
        const bool may_leave_out = sought.open || can_be_left_out();
        if (sought.shows_all && (as_points || may_leave_out)) inner.DrawArrays(mode, 0, 0);
        if (!may_leave_out) return true;
        Selection seen = sought.open ? pieces_in_tiles(*place) : pieces_of_outline(*place);
        if (seen.parts.empty()) return false;
        parts = std::move(seen.parts);
        return true;
    }

    Selection pieces_in_tiles(const DrawPlace& place) const {
        Selection seen;
        for (const DrawCover::Piece& piece : places->cover_of(next - 1, place, *sought.open).pieces)
            if (sought.open->meet(piece.cover)) seen.add(piece.part);
        return seen;
    }

    Selection pieces_of_outline(const DrawPlace& place) const {
        Selection seen;
        const auto left_out = [&](const Place& of) {
            return sought.outline->leave_out(of, places->around()->lo, places->around()->hi);
        };
        for (const DrawPlace::Part& part : place.parts) {
            if (left_out(part.place)) continue;
            for (const auto& piece : as_points ? vertices_of(place, part) : primitives_of(place, part))
                if (!left_out(piece.place)) seen.add(piece);
        }
        return seen;
    }

    /// From an outline: where corners are drawn as points, these reach no farther than a pixel.
    bool can_be_left_out() const {
        if (!sought.outline || !places->around()) return false;
        GLfloat size = 1, least = 0, attenuation[3] = {1, 0, 0};
        inner.GetFloatv(GL_POINT_SIZE, &size);
        inner.GetFloatv(GL_POINT_SIZE_MIN, &least);
        inner.GetFloatv(GL_POINT_DISTANCE_ATTENUATION, attenuation);
        return size <= 1 && least <= 1 && attenuation[0] == 1 && attenuation[1] == 0 && attenuation[2] == 0;
    }

    /// As GL_POINTS, the vertices of polygons are neither clipped nor tested otherwise than as corners.
    bool points_are_the_same() const {
        GLint planes = 6;
        inner.GetIntegerv(GL_MAX_CLIP_PLANES, &planes);
        for (GLint i = 0; i < planes; ++i)
            if (inner.IsEnabled(GL_CLIP_PLANE0 + static_cast<GLenum>(i))) return false;
        return !inner.IsEnabled(GL_ALPHA_TEST);
    }

    const Scene& scene;
    const int group;
    const Wanted wanted;
    const Sought sought;
    DrawPlaces* places;
    EyeSpace eye_space{inner};
    HiddenFaces hidden_faces{inner};
    std::size_t next = 0;
    bool blending = false;
};

} // namespace

bool is_reflection(const Draw& draw, const Group& group) {
    return draw.stencilled && group.open_triangles[draw.mirrors] < group.open_triangles[!draw.mirrors];
}

bool is_solid(const Draw& draw, const Group& of, bool backdrops) {
    if (draw.kind != (of.triangles > 0 ? Draw::Kind::filled : Draw::Kind::outlined)) return false;
    if (is_reflection(draw, of) || draw.is_outline || draw.shown == Draw::Shown::none) return false;
    if (draw.is_decal) return true;
    if (draw.left_out) return backdrops;
    if (!of.writes_depth || draw.writes_depth) return true;
    return draw.before_depth ? backdrops && draw.writes_colour : draw.tests_depth;
}

void Sides::add(const Sides& more) {
    coloured |= more.coloured, culled |= more.culled;
    lit_on_both |= more.lit_on_both, lit_as_front |= more.lit_as_front;
}

Sides sides_of(const Scene& scene, int group) {
    Sides sides;
    std::set<long> by_culled[2]; // triangles of draws without fronts, without backs
    for (const Draw& draw : scene.draws) {
        if (draw.group != group || !is_solid(draw, scene.groups[group], false)) continue;
        sides.add({draw.two_colours, false, draw.lit_on_both, draw.lit_as_front});
        if (draw.culled == GL_FRONT || draw.culled == GL_BACK)
            by_culled[draw.culled == GL_BACK].insert(draw.triangles);
    }
    for (const long triangles : by_culled[0])
        sides.culled |= triangles > 0 && by_culled[1].contains(triangles);
    return sides;
}

bool Group::same_place(const Group& other) const {
    if (framebuffer != other.framebuffer || draw_buffer != other.draw_buffer || viewport != other.viewport ||
        kind != other.kind || unscale != other.unscale)
        return false;
    if (projection == other.projection) return true;
    return camera && other.camera && to_space_of(*camera, *other.camera) == glm::dmat4(1.0);
}

/// In perspective the eye tells which way is which, be the depth row what it may; else the depth that is in
/// front.
bool Group::is_mirrored() const {
    const bool turned = glm::determinant(unscale) < 0;
    if (kind == ProjectionKind::perspective && camera) return glcast::is_mirrored(*camera) != turned;
    const double determinant = glm::determinant(projection);
    return determinant != 0 && ((determinant > 0) != depth_reversed) != turned;
}

long cutting_draws(const std::vector<Scene>& scenes, const Group& group) {
    long draws = 0;
    if (group.at_equal_depth == 0 || group.depth_reversed) return 0;
    for (const Scene& scene : scenes)
        for (const Group& other : scene.groups)
            if (other.projection == group.projection) draws += other.at_greater_depth;
    return draws;
}

void replay_group(const record::Frame& frame, const Scene& scene, int group, const Wanted& wanted,
                  const GlTable& gl, const Sought& sought, DrawPlaces* places) {
    GroupFilter filter(gl, scene, group, wanted, sought, places);
    if (sought.only_places && !frame.prepared) return;
    record::replay(frame, gated_table(filter));
    filter.finish();
}

std::string describe(const Group& group) {
    constexpr const char* kinds[] = {"perspective", "orthographic with depth test", "flat"};
    std::string text = std::to_string(group.triangles) + " triangles in " + std::to_string(group.draws) +
                       (group.draws == 1 ? " draw, " : " draws, ") + kinds[static_cast<int>(group.kind)] +
                       ", viewport";
    for (const GLint number : group.viewport) text += " " + std::to_string(number);
    if (group.framebuffer) text += ", framebuffer " + std::to_string(group.framebuffer);
    if (group.outlined) text += ", " + std::to_string(group.outlined) + " more as outlines";
    if (group.lines) text += ", " + std::to_string(group.lines) + " lines";
    if (group.points) text += ", " + std::to_string(group.points) + " points";
    if (group.erased) text += ", painted over";
    return text;
}

namespace {

struct Corners {
    glm::dvec3 lo{INFINITY}, hi{-INFINITY};
};

/// What the projection takes to (0, 0, z, 0). The view may be part of it, so it need not be the origin.
glm::dvec3 where_rays_meet(const glm::dmat4& clip_to_eye) {
    const glm::dvec4 eye = clip_to_eye * glm::dvec4(0, 0, -1, 0);
    return glm::dvec3(eye) / eye.w;
}

/// Of what a projection shows, its far plane no further than `far_ratio`.
Corners corners_of(const glm::dmat4& projection, const Group& group, const glm::dmat4& eye_to_capture,
                   double far_ratio) {
    const glm::dmat4 to_eye = glm::inverse(projection);
    const glm::dvec3 eye = where_rays_meet(to_eye);
    Corners corners;
    for (int corner = 0; corner < 4; ++corner) {
        const double x = corner & 1 ? 1 : -1, y = corner & 2 ? 1 : -1;
        const double front = group.depth_reversed ? 1 : -1;
        const glm::dvec4 near_clip = to_eye * glm::dvec4(x, y, front, 1),
                         far_clip = to_eye * glm::dvec4(x, y, -front, 1);
        const glm::dvec3 near_point = glm::dvec3(near_clip) / near_clip.w;
        glm::dvec3 far_point = glm::dvec3(far_clip) / far_clip.w;
        if (group.kind == ProjectionKind::perspective) {
            // An infinite far plane has w = 0, and rounding may put it behind the eye.
            const glm::dvec3 ray = near_point - eye;
            const double ratio = glm::dot(far_point - eye, ray) / glm::dot(ray, ray);
            if (!(ratio > 0 && ratio < far_ratio)) far_point = eye + ray * far_ratio;
        }
        for (const glm::dvec3& point : {near_point, far_point}) {
            const glm::dvec3 p(eye_to_capture * glm::dvec4(point, 1));
            corners.lo = glm::min(corners.lo, p), corners.hi = glm::max(corners.hi, p);
        }
    }
    return corners;
}

double longest_side(const Corners& corners) {
    const glm::dvec3 size = corners.hi - corners.lo;
    return std::max({size.x, size.y, size.z});
}

} // namespace

std::optional<glm::dvec3> eye_of(const Group& group, const glm::dmat4& eye_to_capture) {
    constexpr double far_away = 1000; // view volumes
    if (group.projections.empty()) return std::nullopt;
    const glm::dmat4 to_eye = glm::inverse(group.projections.front());
    glm::dvec3 eye;
    if (group.kind == ProjectionKind::perspective) {
        eye = where_rays_meet(to_eye);
    } else {
        const double front = group.depth_reversed ? 1 : -1;
        const glm::dvec3 near(to_eye * glm::dvec4(0, 0, front, 1)), far(to_eye * glm::dvec4(0, 0, -front, 1));
        eye = near + (near - far) * far_away;
    }
    eye = glm::dvec3(eye_to_capture * glm::dvec4(eye, 1));
    const bool is_finite = std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z);
    return is_finite ? std::optional(eye) : std::nullopt;
}

std::optional<Box> view_volume(const Group& group, const glm::dmat4& eye_to_capture, double far_ratio) {
    Corners all;
    for (const glm::dmat4& projection : group.projections) {
        const Corners one = corners_of(projection, group, eye_to_capture, far_ratio);
        const double edge = longest_side(one);
        if (!std::isfinite(edge) || edge <= 0) continue;
        all.lo = glm::min(all.lo, one.lo), all.hi = glm::max(all.hi, one.hi);
    }
    const double edge = longest_side(all);
    if (!std::isfinite(edge) || edge <= 0) return std::nullopt;
    return Box{(all.lo + all.hi - edge) / 2.0, edge};
}

} // namespace glcast::preload
