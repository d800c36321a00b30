#include "shim/preload/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <numeric>

#include "shim/preload/scene_table.h"

namespace glcast::preload {
namespace {

glm::dmat4 get_matrix(const GlTable& gl, GLenum name) {
    glm::dmat4 matrix(1.0);
    gl.GetDoublev(name, glm::value_ptr(matrix));
    return matrix;
}

bool is_perspective(const glm::dmat4& p) { return p[0][3] != 0 || p[1][3] != 0 || p[2][3] != 0; }

/// Notes every draw with the state that it meets, and draws none.
class Analysis final : public DrawGate {
  public:
    using DrawGate::DrawGate;
    Scene scene;

    bool draws_nothing() const override { return true; }
    void framebuffer_bound(GLuint name) override { framebuffer = name; }

    void before_push() override {
        GLint matrix_mode = 0;
        if (!scene.base_modelview) inner.GetIntegerv(GL_MATRIX_MODE, &matrix_mode);
        if (matrix_mode == GL_MODELVIEW) scene.base_modelview = get_matrix(inner, GL_MODELVIEW_MATRIX);
    }

    bool keep(bool polygons, long triangles) override {
        const int index = find_group();
        const auto kind = !polygons          ? Draw::Kind::lines_or_points
                          : fills_polygons() ? Draw::Kind::filled
                                             : Draw::Kind::outlined;
        scene.draws.push_back({index, kind});
        ++scene.groups[index].draws;
        add_triangles(triangles);
        if (!scene.base_modelview && scene.groups[index].kind != ProjectionKind::flat)
            scene.base_modelview = get_matrix(inner, GL_MODELVIEW_MATRIX);
        return false;
    }

    void add_triangles(long triangles) override {
        if (scene.draws.empty()) return; // a lone glEnd
        const Draw& draw = scene.draws.back();
        Group& group = scene.groups[draw.group];
        if (draw.kind == Draw::Kind::filled) group.triangles += triangles;
        if (draw.kind == Draw::Kind::outlined) group.outlined += triangles;
    }

  private:
    bool fills_polygons() const {
        GLint modes[2] = {GL_FILL, GL_FILL};
        inner.GetIntegerv(GL_POLYGON_MODE, modes);
        return modes[0] == GL_FILL || modes[1] == GL_FILL;
    }

    int find_group() {
        Group now;
        now.framebuffer = framebuffer;
        inner.GetIntegerv(GL_VIEWPORT, now.viewport.data());
        now.projection = get_matrix(inner, GL_PROJECTION_MATRIX);
        now.kind = is_perspective(now.projection)   ? ProjectionKind::perspective
                   : inner.IsEnabled(GL_DEPTH_TEST) ? ProjectionKind::orthographic
                                                    : ProjectionKind::flat;
        const auto same = [&](const Group& g) {
            return g.framebuffer == now.framebuffer && g.viewport == now.viewport && g.kind == now.kind &&
                   g.projection == now.projection;
        };
        const auto at = std::find_if(scene.groups.rbegin(), scene.groups.rend(), same);
        if (at != scene.groups.rend()) return static_cast<int>(scene.groups.rend() - at) - 1;
        scene.groups.push_back(now);
        return static_cast<int>(scene.groups.size()) - 1;
    }

    GLuint framebuffer = 0;
};

/// Lets through the draws of one group: filled ones, or outlined ones where it has no filled ones.
class GroupFilter final : public DrawGate {
  public:
    GroupFilter(const GlTable& gl, const Scene& of, int index)
        : DrawGate(gl), scene(of), group(index),
          wanted(of.groups[index].triangles > 0 ? Draw::Kind::filled : Draw::Kind::outlined) {}

    bool keep(bool, long) override {
        if (next >= scene.draws.size()) return false;
        const Draw& draw = scene.draws[next++];
        return draw.group == group && draw.kind == wanted;
    }

  private:
    const Scene& scene;
    const int group;
    const Draw::Kind wanted;
    std::size_t next = 0;
};

/// Sorted so that the first is what people mean; numbers in `draws` follow.
void sort_groups(Scene& scene) {
    std::vector<int> order(scene.groups.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](int i) {
        const Group& g = scene.groups[i];
        return std::tuple(g.is_scene(), g.triangles, g.outlined, g.draws);
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) > rank(b); });
    std::vector<Group> sorted;
    std::vector<int> new_index(order.size());
    for (const int old : order) {
        new_index[old] = static_cast<int>(sorted.size());
        sorted.push_back(scene.groups[old]);
    }
    scene.groups = std::move(sorted);
    for (Draw& draw : scene.draws) draw.group = new_index[draw.group];
}

} // namespace

// The prologue pushes matrices of its own where the frame starts with some on the stack: none of them is the base.
Scene analyse(const record::Frame& frame, const GlTable& gl) {
    Analysis analysis(gl);
    record::replay(frame, gated_table(analysis), [&] { analysis.scene.base_modelview.reset(); });
    sort_groups(analysis.scene);
    return std::move(analysis.scene);
}

void replay_group(const record::Frame& frame, const Scene& scene, int group, const GlTable& gl) {
    GroupFilter filter(gl, scene, group);
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
    return text;
}

std::optional<Box> view_volume(const Group& group, const glm::dmat4& eye_to_capture, double far_ratio) {
    const glm::dmat4 to_eye = glm::inverse(group.projection);
    glm::dvec3 lo(INFINITY), hi(-INFINITY);
    for (int corner = 0; corner < 4; ++corner) {
        const double x = corner & 1 ? 1 : -1, y = corner & 2 ? 1 : -1;
        const glm::dvec4 near_clip = to_eye * glm::dvec4(x, y, -1, 1),
                         far_clip = to_eye * glm::dvec4(x, y, 1, 1);
        const glm::dvec3 near_point = glm::dvec3(near_clip) / near_clip.w;
        glm::dvec3 far_point = glm::dvec3(far_clip) / far_clip.w;
        if (group.kind == ProjectionKind::perspective) {
            // An infinite far plane has w = 0, and rounding may put it behind the eye.
            const double ratio = far_point.z / near_point.z;
            if (!(ratio > 0 && ratio < far_ratio)) far_point = near_point * far_ratio;
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
