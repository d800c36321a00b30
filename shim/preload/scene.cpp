#include "shim/preload/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "shim/preload/scene_table.h"

namespace glcast::preload {
namespace {

glm::dmat4 get_matrix(const GlTable& gl, GLenum name) {
    glm::dmat4 matrix(1.0);
    gl.GetDoublev(name, glm::value_ptr(matrix));
    return matrix;
}

GLint get_int(const GlTable& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

bool is_perspective(const glm::dmat4& p) { return p[0][3] != 0 || p[1][3] != 0 || p[2][3] != 0; }

bool mirrors(const glm::dmat4& modelview) { return glm::determinant(glm::dmat3(modelview)) < 0; }

bool contains(const std::array<GLint, 4>& outer, const std::array<GLint, 4>& inner) {
    return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[0] + outer[2] >= inner[0] + inner[2] &&
           outer[1] + outer[3] >= inner[1] + inner[3];
}

/// Notes every draw with the state that it meets, and draws none.
class Analysis final : public DrawGate {
  public:
    using DrawGate::DrawGate;
    Scene scene;

    bool draws_nothing() const override { return true; }
    void framebuffer_bound(GLuint name) override { framebuffer = name; }
    void pixels_drawn() override { ++scene.pixels; }

    /// What the prologue pushed and set is not the frame's own.
    void calls_begin() { pushed.reset(); }

    void before_push() override {
        if (pushed || get_int(inner, GL_MATRIX_MODE) != GL_MODELVIEW) return;
        const glm::dmat4 modelview = get_matrix(inner, GL_MODELVIEW_MATRIX);
        if (modelview != glm::dmat4(1.0)) pushed = modelview;
    }

    /// What was drawn before to the same place is no longer seen.
    void cleared(GLbitfield buffers) override {
        if (!(buffers & GL_COLOR_BUFFER_BIT)) return;
        GLboolean mask[4] = {};
        inner.GetBooleanv(GL_COLOR_WRITEMASK, mask);
        if (!(mask[0] && mask[1] && mask[2])) return;
        std::array<GLint, 4> scissor{};
        const bool scissored = inner.IsEnabled(GL_SCISSOR_TEST);
        if (scissored) inner.GetIntegerv(GL_SCISSOR_BOX, scissor.data());
        const GLint buffer = get_int(inner, GL_DRAW_BUFFER);
        for (Group& group : scene.groups)
            if (group.framebuffer == framebuffer && group.draw_buffer == buffer &&
                (!scissored || contains(scissor, group.viewport)))
                group.erased = true;
    }

    bool keep(GLenum mode, long primitives) override {
        const bool tests = inner.IsEnabled(GL_DEPTH_TEST);
        const GLint function = get_int(inner, GL_DEPTH_FUNC);
        const int index = find_group(tests, function);
        Group& group = scene.groups[index];
        Draw draw;
        draw.group = index;
        draw.kind = kind_of(mode);
        draw.tests_depth = tests && function != GL_ALWAYS;
        GLboolean mask = GL_TRUE;
        inner.GetBooleanv(GL_DEPTH_WRITEMASK, &mask);
        draw.writes_depth = tests && mask;
        draw.before_depth = !group.writes_depth;
        draw.stencilled = inner.IsEnabled(GL_STENCIL_TEST) && get_int(inner, GL_STENCIL_FUNC) != GL_ALWAYS;
        draw.is_open = draw.writes_depth && !draw.stencilled && writes_colour();
        draw.mirrors = mirrors(get_matrix(inner, GL_MODELVIEW_MATRIX));
        if (draw.kind == Draw::Kind::filled || draw.kind == Draw::Kind::outlined)
            group.writes_depth |= draw.writes_depth;
        if (!group.base_modelview || (group.base_is_stencilled && !draw.stencilled)) {
            group.base_modelview = pushed ? *pushed : get_matrix(inner, GL_MODELVIEW_MATRIX);
            group.base_is_stencilled = draw.stencilled;
        }
        pushed.reset();
        if (has_faces(mode) && tests) {
            group.at_equal_depth += function == GL_EQUAL;
            const bool greater = function == GL_GREATER || function == GL_GEQUAL;
            group.at_greater_depth += greater && draw.stencilled && !inner.IsEnabled(GL_BLEND);
        }
        ++group.draws;
        group.last_draw = static_cast<long>(scene.draws.size());
        scene.draws.push_back(draw);
        add_primitives(primitives);
        return false;
    }

    void add_primitives(long number) override {
        if (scene.draws.empty()) return; // a lone glEnd
        const Draw& draw = scene.draws.back();
        Group& group = scene.groups[draw.group];
        (draw.kind == Draw::Kind::filled     ? group.triangles
         : draw.kind == Draw::Kind::outlined ? group.outlined
         : draw.kind == Draw::Kind::line     ? group.lines
                                             : group.points) += number;
        if (draw.kind == Draw::Kind::filled && draw.is_open) group.open_triangles[draw.mirrors] += number;
    }

  private:
    bool writes_colour() const {
        GLboolean mask[4] = {};
        inner.GetBooleanv(GL_COLOR_WRITEMASK, mask);
        return mask[0] || mask[1] || mask[2];
    }

    Draw::Kind kind_of(GLenum mode) const {
        if (mode == GL_POINTS) return Draw::Kind::point;
        if (!has_faces(mode)) return Draw::Kind::line;
        GLint modes[2] = {GL_FILL, GL_FILL};
        inner.GetIntegerv(GL_POLYGON_MODE, modes);
        return modes[0] == GL_FILL || modes[1] == GL_FILL ? Draw::Kind::filled : Draw::Kind::outlined;
    }

    int find_group(bool tests_depth, GLint depth_function) {
        Group now;
        now.framebuffer = framebuffer;
        now.draw_buffer = get_int(inner, GL_DRAW_BUFFER);
        inner.GetIntegerv(GL_VIEWPORT, now.viewport.data());
        now.projection = get_matrix(inner, GL_PROJECTION_MATRIX);
        now.kind = is_perspective(now.projection) ? ProjectionKind::perspective
                   : tests_depth                  ? ProjectionKind::orthographic
                                                  : ProjectionKind::flat;
        const auto same = [&](const Group& g) { return !g.erased && g.same_place(now); };
        const auto at = std::find_if(scene.groups.rbegin(), scene.groups.rend(), same);
        if (at != scene.groups.rend()) return static_cast<int>(scene.groups.rend() - at) - 1;
        GLfloat range[2] = {0, 1};
        inner.GetFloatv(GL_DEPTH_RANGE, range);
        const bool greater = tests_depth && (depth_function == GL_GREATER || depth_function == GL_GEQUAL);
        now.depth_reversed = greater != (range[0] > range[1]);
        scene.groups.push_back(now);
        return static_cast<int>(scene.groups.size()) - 1;
    }

    GLuint framebuffer = 0;
    std::optional<glm::dmat4> pushed; ///< at the first push since the last draw
};

/// Lets through the draws of one group that are asked for.
class GroupFilter final : public DrawGate {
  public:
    GroupFilter(const GlTable& gl, const Scene& of, int index, const Wanted& what)
        : DrawGate(gl), scene(of), group(index), wanted(what) {}

    bool blends(bool on) override {
        blending = on;
        return wanted.transparent == Transparent::by_alpha;
    }
    bool blending_restored() override {
        return wanted.transparent != Transparent::by_alpha;
    }

    bool keep(GLenum, long) override {
        if (next >= scene.draws.size()) return false;
        const Draw& draw = scene.draws[next++];
        if (draw.group != group) return false;
        if (wanted.transparent == Transparent::skip && blending) return false;
        if (wanted.everything) return true;
        if (draw.kind == Draw::Kind::line) return wanted.lines;
        if (draw.kind == Draw::Kind::point) return wanted.points;
        return wanted.solid && is_solid(draw, scene.groups[group]);
    }

  private:
    static bool is_solid(const Draw& draw, const Group& of) {
        if (draw.kind != (of.triangles > 0 ? Draw::Kind::filled : Draw::Kind::outlined)) return false;
        if (draw.stencilled && of.open_triangles[draw.mirrors] < of.open_triangles[!draw.mirrors])
            return false;
        if (!of.writes_depth || draw.writes_depth) return true;
        return draw.tests_depth && !draw.before_depth;
    }

    const Scene& scene;
    const int group;
    const Wanted wanted;
    std::size_t next = 0;
    bool blending = false;
};

} // namespace

bool Group::same_place(const Group& other) const {
    return framebuffer == other.framebuffer && draw_buffer == other.draw_buffer && viewport == other.viewport &&
           kind == other.kind && projection == other.projection;
}

long cutting_draws(const std::vector<Scene>& scenes, const Group& group) {
    long draws = 0;
    if (group.at_equal_depth == 0 || group.depth_reversed) return 0;
    for (const Scene& scene : scenes)
        for (const Group& other : scene.groups)
            if (other.projection == group.projection) draws += other.at_greater_depth;
    return draws;
}

// The prologue pushes matrices of its own where the frame starts with some on the stack: none of them is the base.
Scene analyse(const record::Frame& frame, const GlTable& gl) {
    Analysis analysis(gl);
    record::replay(frame, gated_table(analysis), [&] { analysis.calls_begin(); });
    return std::move(analysis.scene);
}

void replay_group(const record::Frame& frame, const Scene& scene, int group, const Wanted& wanted,
                  const GlTable& gl) {
    GroupFilter filter(gl, scene, group, wanted);
    record::replay(frame, gated_table(filter));
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

std::optional<Box> view_volume(const Group& group, const glm::dmat4& eye_to_capture, double far_ratio) {
    const glm::dmat4 to_eye = glm::inverse(group.projection);
    // Where all rays meet: what the projection takes to (0, 0, z, 0). The view may be part of it, so it need not
    // be the origin.
    const glm::dvec4 eye_clip = to_eye * glm::dvec4(0, 0, -1, 0);
    const glm::dvec3 eye = glm::dvec3(eye_clip) / eye_clip.w;
    glm::dvec3 lo(INFINITY), hi(-INFINITY);
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
            lo = glm::min(lo, p), hi = glm::max(hi, p);
        }
    }
    const glm::dvec3 size = hi - lo;
    const double edge = std::max({size.x, size.y, size.z});
    if (!std::isfinite(edge) || edge <= 0) return std::nullopt;
    return Box{(lo + hi - edge) / 2.0, edge};
}

} // namespace glcast::preload
