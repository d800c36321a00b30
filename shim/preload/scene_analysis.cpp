#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "capture/forced_state.h"
#include "capture/gl/gl_query.h"
#include "capture/solidity.h"
#include "shim/preload/feedback_probe.h"
#include "shim/preload/scene.h"
#include "shim/preload/scene_table.h"
#include "shim/preload/similarity.h"
#include "shim/preload/way_to_window.h"

namespace glcast::preload {
namespace {

constexpr std::size_t most_projections = 16; ///< of a group that the search for its box looks at
constexpr double guessed_degrees = 45;

glm::dmat4 get_matrix(const GlTable& gl, GLenum name) {
    glm::dmat4 matrix(1.0);
    gl.GetDoublev(name, glm::value_ptr(matrix));
    return matrix;
}

bool mirrors(const glm::dmat4& modelview) { return glm::determinant(glm::dmat3(modelview)) < 0; }

bool contains(const std::array<GLint, 4>& outer, const std::array<GLint, 4>& inner) {
    return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[0] + outer[2] >= inner[0] + inner[2] &&
           outer[1] + outer[3] >= inner[1] + inner[3];
}

/// The scale that stands before the view in a modelview matrix; none where a model is scaled.
std::optional<glm::dmat4> scale_before_view(const glm::dmat4& projection, const glm::dmat4& modelview) {
    const auto of_rows = [&]() -> std::optional<glm::dvec3> {
        if (const auto scale = find_scale_of_rows(modelview)) return scale;
        // glOrtho alone, and no view yet.
        const glm::dvec3 diagonal(modelview[0][0], modelview[1][1], modelview[2][2]);
        glm::dmat4 rest = modelview;
        for (int i = 0; i < 3; ++i) rest[i][i] = 1, rest[3][i] = 0;
        const bool is_ortho = projection == glm::dmat4(1.0) && rest == glm::dmat4(1.0) && diagonal.x > 0 &&
                              diagonal.y > 0 && diagonal.z < 0;
        return is_ortho ? std::optional(diagonal) : std::nullopt;
    };
    const auto scale = of_rows();
    if (!scale) return std::nullopt;
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 3; ++i) matrix[i][i] = (*scale)[i];
    return matrix;
}

bool lights_two_sides(const GlTable& gl) {
    GLboolean two_sided = GL_FALSE;
    gl.GetBooleanv(GL_LIGHT_MODEL_TWO_SIDE, &two_sided);
    return two_sided;
}

/// Of what is lit from two sides: backs have a material of their own, with a colour that ours show.
bool has_two_colours(const GlTable& gl) {
    GLenum tracked = GL_NONE;
    if (gl.IsEnabled(GL_COLOR_MATERIAL)) {
        tracked = mapped_material(static_cast<GLenum>(get_int(gl, GL_COLOR_MATERIAL_PARAMETER)));
        const bool of_one = get_int(gl, GL_COLOR_MATERIAL_FACE) != GL_FRONT_AND_BACK;
        if (of_one && tracked != GL_NONE) return true;
    }
    for (const GLenum name : {GL_DIFFUSE, GL_EMISSION}) {
        std::array<GLfloat, 4> front{}, back{};
        gl.GetMaterialfv(GL_FRONT, name, front.data());
        gl.GetMaterialfv(GL_BACK, name, back.data());
        if (front != back && mapped_material(name) != tracked) return true;
    }
    return false;
}

/// A similarity, be it one that mirrors.
bool keeps_shapes(const glm::dmat4& to_eye) {
    glm::dmat4 other = to_eye;
    if (mirrors(to_eye)) other[2] = -other[2];
    return is_similarity(other);
}

/// What a further look at the frame is to find out, found to be wanting by the first.
struct Questions {
    std::vector<std::size_t> with_w; ///< draws of vertices with a w of their own, rising
};

/// Notes every draw with the state that it meets, and draws none.
class Analysis final : public DrawGate {
  public:
    Analysis(const GlTable& gl, Sights& known, const Questions& asked)
        : DrawGate(gl), sights(known), questions(asked) {}
    Scene scene;
    Questions open; ///< for another look

    bool draws_nothing() const override { return true; }
    void framebuffer_bound(GLenum target, GLuint name) override {
        if (target != GL_READ_FRAMEBUFFER) framebuffer = name;
        if (target != GL_DRAW_FRAMEBUFFER) read_framebuffer = name;
    }
    void pixels_drawn() override { ++scene.pixels; }
    void blitted(const BlitRect& source, const BlitRect& target) override {
        way.blit(read_framebuffer, framebuffer, source, target);
    }

    /// What the prologue pushed and set is not the frame's own.
    void calls_begin() { pushed.reset(); }

    void before_push() override {
        if (pushed || get_int(inner, GL_MATRIX_MODE) != GL_MODELVIEW) return;
        const glm::dmat4 modelview = get_matrix(inner, GL_MODELVIEW_MATRIX);
        if (modelview != glm::dmat4(1.0)) pushed = modelview;
    }

    /// What was drawn before to the same place is no longer seen.
    void cleared(GLbitfield buffers) override {
        if (buffers & GL_STENCIL_BUFFER_BIT)
            scene.stencil_events.emplace_back(stencil_clear_now(inner, framebuffer));
        if (!(buffers & GL_COLOR_BUFFER_BIT)) return;
        GLboolean mask[4] = {};
        inner.GetBooleanv(GL_COLOR_WRITEMASK, mask);
        if (!(mask[0] && mask[1] && mask[2])) return;
        std::array<GLint, 4> scissor{};
        const bool scissored = inner.IsEnabled(GL_SCISSOR_TEST);
        if (scissored) inner.GetIntegerv(GL_SCISSOR_BOX, scissor.data());
        if (get_int(inner, GL_DRAW_BUFFER) == GL_NONE) return;
        const GLint buffer = shown_buffer();
        for (Group& group : scene.groups)
            if (group.framebuffer == framebuffer && group.draw_buffer == buffer &&
                (!scissored || contains(scissor, group.viewport)))
                group.erased = true;
    }

    bool keep(GLenum mode, long primitives) override {
        const bool tests = inner.IsEnabled(GL_DEPTH_TEST);
        const GLint function = get_int(inner, GL_DEPTH_FUNC);
        const glm::dmat4 modelview = get_matrix(inner, GL_MODELVIEW_MATRIX);
        std::array<GLint, 4> viewport{};
        inner.GetIntegerv(GL_VIEWPORT, viewport.data());
        const Sight& sight = sights.look(get_matrix(inner, GL_PROJECTION_MATRIX), modelview, viewport);
        const int index = find_group(sight, viewport, tests, function, modelview);
        Group& group = scene.groups[index];
        Draw draw;
        draw.group = index;
        draw.shown = has_faces(mode) ? shown() : Draw::Shown::both;
        draw.kind = kind_of(mode);
        draw.tests_depth = tests && function != GL_ALWAYS;
        GLboolean mask = GL_TRUE;
        inner.GetBooleanv(GL_DEPTH_WRITEMASK, &mask);
        draw.writes_depth = tests && mask;
        draw.before_depth = !group.writes_depth;
        draw.writes_colour = writes_colour();
        const bool tests_stencil = inner.IsEnabled(GL_STENCIL_TEST), colours = writes_colour();
        draw.stencilled = tests_stencil && get_int(inner, GL_STENCIL_FUNC) != GL_ALWAYS;
        if (draw.kind == Draw::Kind::filled && inner.IsEnabled(GL_CULL_FACE) && colours)
            draw.culled = static_cast<GLenum>(get_int(inner, GL_CULL_FACE_MODE));
        draw.is_open = draw.writes_depth && !draw.stencilled && colours;
        draw.hides = draw.writes_depth && !tests_stencil && !colours && draw.kind == Draw::Kind::filled;
        draw.textured = is_textured();
        draw.lit = inner.IsEnabled(GL_LIGHTING);
        draw.pinned = tests && is_pinned(group);
        draw.eye_map = eye_map_of(sight, group);
        const EyeMap* map = draw.eye_map >= 0 ? &scene.eye_maps[draw.eye_map] : nullptr;
        draw.mirrors = mirrors(map ? map->apply(modelview) : modelview);
        if (group.depth && sight.depth && sight.projection != group.projection)
            draw.nudge = depth_nudge(*group.depth, *sight.depth, sight.perspective);
        if (draw.kind == Draw::Kind::filled || draw.kind == Draw::Kind::outlined)
            group.writes_depth |= draw.writes_depth;
        if (!group.base_modelview || (group.base_is_stencilled && !draw.stencilled)) {
            const bool from_push = pushed && is_projective(*pushed) == sight.in_modelview;
            const glm::dmat4& base = from_push ? *pushed : modelview;
            group.base_modelview = map ? map->apply(base) : base;
            group.base_is_stencilled = draw.stencilled;
        }
        pushed.reset();
        group.judged_by_function += has_faces(mode) && blends_by_colour();
        if (has_faces(mode) && tests) {
            group.at_equal_depth += function == GL_EQUAL;
            const bool greater = function == GL_GREATER || function == GL_GEQUAL;
            group.at_greater_depth += greater && draw.stencilled && !inner.IsEnabled(GL_BLEND);
        }
        ++group.draws;
        group.last_draw = static_cast<long>(scene.draws.size());
        hands_over_clip = sight.projection == glm::dmat4(1.0) && modelview == glm::dmat4(1.0);
        if (tests_stencil) scene.stencil_events.emplace_back(stencil_draw_now(inner, scene.draws.size()));
        scene.draws.push_back(draw);
        add_primitives(primitives);
        return ask(sight);
    }

    void add_primitives(long number) override {
        if (scene.draws.empty()) return; // a lone glEnd
        Draw& draw = scene.draws.back();
        Group& group = scene.groups[draw.group];
        draw.triangles += number;
        (draw.kind == Draw::Kind::filled     ? group.triangles
         : draw.kind == Draw::Kind::outlined ? group.outlined
         : draw.kind == Draw::Kind::line     ? group.lines
                                             : group.points) += number;
        if (draw.hides) group.hidden_triangles += number;
        if (draw.kind == Draw::Kind::filled && draw.is_open) group.open_triangles[draw.mirrors] += number;
        if (gives_w && hands_over_clip) wonder_about_w();
        if (draw.kind == Draw::Kind::filled && inner.IsEnabled(GL_LIGHTING)) note_lit_sides(draw);
    }

    void note_lit_sides(Draw& draw) {
        const bool two_sided = lights_two_sides(inner);
        (two_sided ? draw.lit_on_both : draw.lit_as_front) = true;
        draw.two_colours |= two_sided && has_two_colours(inner);
    }

    void drawn() override {
        if (!probe.is_open()) return;
        const auto polygons = probe.end();
        if (shown_texture) return way.show_texture(*shown_texture, framebuffer, shows_mirrored(polygons));
        DepthLineFit& fit = clip_draws[scene.draws.back().group][scene.draws.size() - 1];
        for (const auto& polygon : polygons)
            for (const auto& vertex : polygon) fit.add(vertex.w, vertex.z);
    }

    /// After the frame.
    void finish(std::optional<double> view_angle) {
        scene.window_has_stencil = get_int(inner, GL_STENCIL_BITS) > 0 || get_int(inner, GL_RED_BITS) == 0;
        for (const auto& [index, fits] : clip_draws) understand(index, fits, view_angle);
        for (Group& group : scene.groups) {
            if (group.framebuffer == 0 || !group.is_spatial()) continue;
            // Where the way is not seen, a picture that only stands on its head is taken to be put on its
            // feet.
            const bool on_its_head =
                group.camera && group.camera->plain && group.camera->lens.fy < 0 && group.camera->lens.fx > 0;
            group.turned_round = way.mirrors(group.framebuffer, inner).value_or(on_its_head);
        }
    }

  private:
    using ClipDraws = std::map<std::size_t, DepthLineFit>; ///< by draw

    bool blends_by_colour() const {
        if (!inner.IsEnabled(GL_BLEND) || inner.IsEnabled(GL_COLOR_LOGIC_OP)) return false;
        const bool has_equations = inner.BlendEquation != nullptr;
        return is_judged_by_function(static_cast<GLenum>(get_int(inner, GL_BLEND_DST)),
                                     has_equations ? static_cast<GLenum>(get_int(inner, GL_BLEND_EQUATION))
                                                   : GL_FUNC_ADD);
    }

    bool writes_colour() const {
        GLboolean mask[4] = {};
        inner.GetBooleanv(GL_COLOR_WRITEMASK, mask);
        return (mask[0] || mask[1] || mask[2]) && get_int(inner, GL_DRAW_BUFFER) != GL_NONE;
    }

    /// glDrawBuffer(GL_NONE) is a mask of colours: the framebuffer's picture is in the buffer that had them
    /// before, or gets them next.
    GLint shown_buffer() {
        const GLint buffer = get_int(inner, GL_DRAW_BUFFER);
        if (buffer != GL_NONE) return shown_buffers[framebuffer] = buffer;
        const auto known = shown_buffers.find(framebuffer);
        if (known != shown_buffers.end()) return known->second;
        if (framebuffer != 0) return GL_COLOR_ATTACHMENT0;
        return get_int(inner, GL_DOUBLEBUFFER, 1) ? GL_BACK : GL_FRONT;
    }

    /// By the texture unit that is active, which in a frame with one is that one.
    bool is_textured() const {
        return inner.IsEnabled(GL_TEXTURE_2D) || inner.IsEnabled(GL_TEXTURE_CUBE_MAP) ||
               inner.IsEnabled(GL_TEXTURE_RECTANGLE) || inner.IsEnabled(GL_TEXTURE_1D);
    }

    bool is_pinned(const Group& group) const {
        GLfloat range[2] = {0, 1};
        inner.GetFloatv(GL_DEPTH_RANGE, range);
        return range[0] == range[1] && range[0] == (group.depth_reversed ? 0 : 1);
    }

    Draw::Shown shown() const {
        if (!inner.IsEnabled(GL_CULL_FACE)) return Draw::Shown::both;
        const GLint culled = get_int(inner, GL_CULL_FACE_MODE);
        if (culled == GL_FRONT_AND_BACK) return Draw::Shown::none;
        const bool front_is_ccw = get_int(inner, GL_FRONT_FACE) == GL_CCW;
        return (culled == GL_BACK) == front_is_ccw ? Draw::Shown::counter_clockwise : Draw::Shown::clockwise;
    }

    Draw::Kind kind_of(GLenum mode) const {
        if (mode == GL_POINTS) return Draw::Kind::point;
        if (!has_faces(mode)) return Draw::Kind::line;
        GLint modes[2] = {GL_FILL, GL_FILL};
        inner.GetIntegerv(GL_POLYGON_MODE, modes);
        const bool culls = inner.IsEnabled(GL_CULL_FACE);
        const GLint culled = culls ? get_int(inner, GL_CULL_FACE_MODE) : 0;
        const bool fills =
            (modes[0] == GL_FILL && culled != GL_FRONT) || (modes[1] == GL_FILL && culled != GL_BACK);
        return fills ? Draw::Kind::filled : Draw::Kind::outlined;
    }

    int find_group(const Sight& sight, const std::array<GLint, 4>& viewport, bool tests_depth,
                   GLint depth_function, const glm::dmat4& modelview) {
        Group now;
        now.framebuffer = framebuffer;
        now.draw_buffer = shown_buffer();
        now.viewport = viewport;
        inner.GetFloatv(GL_COLOR_CLEAR_VALUE, now.background.data());
        now.projection = sight.projection;
        now.kind = sight.perspective ? ProjectionKind::perspective
                   : tests_depth     ? ProjectionKind::orthographic
                                     : ProjectionKind::flat;
        const auto same = [&](const Group& g) { return !g.erased && same_place(g, now) && sees(g, sight); };
        const auto at = std::find_if(scene.groups.rbegin(), scene.groups.rend(), same);
        if (at != scene.groups.rend()) {
            add_projection(*at, sight);
            return static_cast<int>(scene.groups.rend() - at) - 1;
        }
        GLfloat range[2] = {0, 1};
        inner.GetFloatv(GL_DEPTH_RANGE, range);
        const bool greater = tests_depth && (depth_function == GL_GREATER || depth_function == GL_GEQUAL);
        now.depth_reversed = greater != (range[0] > range[1]);
        now.camera = sight.camera;
        now.depth = sight.depth;
        if (now.camera && now.camera->lens.perspective && !keeps_shapes(now.camera->to_eye)) {
            now.in_screen_space = true;
            now.camera->to_eye = glm::dmat4(1.0);
        }
        const glm::dmat4& base = pushed && !is_projective(*pushed) ? *pushed : modelview;
        if (const auto scale = sight.in_modelview ? std::nullopt : scale_before_view(sight.projection, base))
            now.unscale = glm::inverse(*scale);
        add_projection(now, sight);
        scene.groups.push_back(now);
        return static_cast<int>(scene.groups.size()) - 1;
    }

    static bool same_place(const Group& a, const Group& b) {
        return a.framebuffer == b.framebuffer && a.draw_buffer == b.draw_buffer && a.viewport == b.viewport &&
               a.kind == b.kind;
    }

    static bool sees(const Group& group, const Sight& sight) {
        if (sight.projection == group.projection && !sight.in_modelview) return true;
        return group.camera && sight.camera && to_space_of(*group.camera, *sight.camera);
    }

    /// From the space that the sight's projection takes to that of the group's.
    static glm::dmat4 between(const Group& group, const Sight& sight) {
        const bool is_its_own = sight.projection == group.projection && !group.in_screen_space;
        if (is_its_own || !group.camera || !sight.camera) return glm::dmat4(1.0);
        return to_space_of(*group.camera, *sight.camera).value_or(glm::dmat4(1.0));
    }

    static void add_projection(Group& group, const Sight& sight) {
        if (group.projections.size() >= most_projections) return;
        glm::dmat4 projection = sight.projection * glm::inverse(group.unscale * between(group, sight));
        if (sight.in_modelview) {
            if (!sight.camera || !sight.depth) return;
            projection = projection_of(sight.camera->lens, *sight.depth);
        }
        const auto& all = group.projections;
        if (std::find(all.begin(), all.end(), projection) == all.end())
            group.projections.push_back(projection);
    }

    int eye_map_of(const Sight& sight, const Group& group) {
        EyeMap map;
        if (!sight.in_modelview) {
            map.rows = group.unscale * between(group, sight);
            if (map.rows == glm::dmat4(1.0)) return -1;
        } else {
            if (!sight.camera) return -1;
            const glm::dmat4 to_group = group.camera ? glm::inverse(group.camera->to_eye) : glm::dmat4(1.0);
            map.rows = to_group * clip_to_eye(sight.camera->lens) * sight.projection;
            map.origin = to_group[3];
        }
        return index_of(map);
    }

    int index_of(const EyeMap& map) {
        auto& maps = scene.eye_maps;
        if (maps.empty() || maps.back().rows != map.rows || maps.back().origin != map.origin)
            maps.push_back(map);
        return static_cast<int>(maps.size()) - 1;
    }

    /// Whether the draw that was noted is to be looked at by feedback.
    bool ask(const Sight& sight) {
        shown_texture.reset();
        const std::size_t number = scene.draws.size() - 1;
        if (hands_over_clip && inner.IsEnabled(GL_VERTEX_ARRAY) && get_int(inner, GL_VERTEX_ARRAY_SIZE) == 4)
            wonder_about_w();
        const auto& asked = questions.with_w;
        if (std::binary_search(asked.begin(), asked.end(), number)) {
            probe.begin();
            return true;
        }
        if (!sight.perspective) shown_texture = texture_of_a_scene();
        if (shown_texture) probe.begin();
        return shown_texture.has_value();
    }

    void wonder_about_w() {
        const std::size_t number = scene.draws.size() - 1;
        if (open.with_w.empty() || open.with_w.back() != number) open.with_w.push_back(number);
    }

    /// That is drawn with, where something spatial was drawn into another framebuffer.
    std::optional<GLuint> texture_of_a_scene() const {
        const auto is_source = [&](const Group& g) {
            return g.framebuffer != 0 && g.framebuffer != framebuffer && g.is_spatial();
        };
        if (std::none_of(scene.groups.begin(), scene.groups.end(), is_source)) return std::nullopt;
        GLint name = 0;
        if (inner.IsEnabled(GL_TEXTURE_2D)) name = get_int(inner, GL_TEXTURE_BINDING_2D);
        if (inner.IsEnabled(GL_TEXTURE_RECTANGLE)) name = get_int(inner, GL_TEXTURE_BINDING_RECTANGLE);
        return name != 0 ? std::optional(static_cast<GLuint>(name)) : std::nullopt;
    }

    /// A group drawn in clip coordinates: what depths tell of near and far planes, and the field of view of
    /// another draw, or as told, or a guess. Then a matrix takes them to eye space.
    void understand(int index, const ClipDraws& fits, std::optional<double> view_angle) {
        Group& group = scene.groups[index];
        const auto odd = [](const auto& each) { return each.second.varies() && !each.second.line(); };
        const auto known = std::find_if(fits.begin(), fits.end(),
                                        [](const auto& each) { return each.second.line().has_value(); });
        const bool all = static_cast<long>(fits.size()) == group.draws;
        if (known == fits.end() || !all || std::any_of(fits.begin(), fits.end(), odd)) {
            group.with_own_w = std::count_if(fits.begin(), fits.end(),
                                             [](const auto& each) { return each.second.varies(); });
            return;
        }
        const DepthLine first = *known->second.line();
        const auto shared = sights.lens_with(first);
        group.guessed_view = !shared && !view_angle;
        const Lens lens =
            shared ? *shared
                   : lens_of_view(view_angle.value_or(guessed_degrees), group.viewport[2], group.viewport[3]);
        group.kind = ProjectionKind::perspective;
        group.camera = Camera{lens, glm::dmat4(1.0), true};
        group.depth = first;
        group.projection = projection_of(lens, first);
        group.projections.clear();
        for (const auto& [draw, fit] : fits) {
            const DepthLine line = fit.line().value_or(first);
            EyeMap map;
            map.rows = clip_to_eye(lens);
            map.rows[2][3] = 1 / line.shift, map.rows[3][3] = -line.slope / line.shift;
            scene.draws[draw].eye_map = index_of(map);
            if (group.projections.size() < most_projections)
                group.projections.push_back(projection_of(lens, line));
        }
    }

    Sights& sights;
    const Questions& questions;
    std::map<GLuint, GLint> shown_buffers; ///< of each framebuffer, what glDrawBuffer chose last but GL_NONE
    GLuint framebuffer = 0, read_framebuffer = 0;
    std::optional<glm::dmat4> pushed; ///< at the first push since the last draw
    bool hands_over_clip = false;     ///< no matrix stands between the last draw's vertices and the picture
    FeedbackProbe probe{inner};
    std::optional<GLuint> shown_texture; ///< by the draw that is probed
    std::map<int, ClipDraws> clip_draws; ///< by group
    WayToWindow way;
};

Scene look(const record::Frame& frame, const GlTable& gl, Sights& sights, Questions& questions,
           std::optional<double> view_angle) {
    const Questions asked = std::exchange(questions, {});
    sights.look_again();
    Analysis analysis(gl, sights, asked);
    record::replay(frame, gated_table(analysis), [&] { analysis.calls_begin(); });
    analysis.finish(view_angle);
    questions = std::move(analysis.open);
    return std::move(analysis.scene);
}

} // namespace

// The prologue pushes matrices of its own where the frame starts with some on the stack: none of them is the
// base. Few frames need a second look.
Scene analyse(const record::Frame& frame, const GlTable& gl, std::optional<double> view_angle) {
    Sights sights;
    Questions questions;
    Scene scene = look(frame, gl, sights, questions, view_angle);
    if (questions.with_w.empty() && !sights.may_know_more()) return scene;
    return look(frame, gl, sights, questions, view_angle);
}

} // namespace glcast::preload
