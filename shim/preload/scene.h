// Which draws of a frame are the scene. Draws are grouped by framebuffer, viewport and projection; one group
// is cast.
#pragma once
#include <array>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/gl/gl_table.h"
#include "capture/view.h"
#include "shim/record/record.h"

namespace glcast::preload {

enum class ProjectionKind {
    perspective,
    orthographic, ///< with the depth test on
    flat,         ///< orthographic without: overlays, text, backgrounds
};

struct Group {
    GLuint framebuffer = 0;
    std::array<GLint, 4> viewport{};
    glm::dmat4 projection{1.0};
    ProjectionKind kind = ProjectionKind::flat;
    long draws = 0;     ///< of any primitive
    long triangles = 0; ///< filled
    long outlined = 0;  ///< triangles drawn as lines or points by glPolygonMode
    bool is_scene() const { return kind != ProjectionKind::flat && triangles + outlined > 0; }
};

/// What one draw of the frame is.
struct Draw {
    int group = 0; ///< index into Scene::groups
    enum class Kind { filled, outlined, lines_or_points } kind = Kind::filled;
};

struct Scene {
    std::vector<Group> groups; ///< what may be cast first, then by triangles, most first
    std::vector<Draw> draws;   ///< in the order of the frame
    /// Modelview at the first glPushMatrix or the first 3-D draw, whichever came first.
    std::optional<glm::dmat4> base_modelview;
};

/// Replays the frame in the current context without drawing anything.
Scene analyse(const record::Frame& frame, const GlTable& gl);

/// Replays the frame, but of its draws only the solid ones of one group.
void replay_group(const record::Frame& frame, const Scene& scene, int group, const GlTable& gl);

/// "3360 triangles in 12 draws, perspective, viewport 0 0 800 600".
std::string describe(const Group& group);

/// A cube around the group's view volume in the capture frame, its far plane taken no further than
/// `far_ratio` times as far away as its near plane. Nothing when the projection has no inverse.
std::optional<Box> view_volume(const Group& group, const glm::dmat4& eye_to_capture, double far_ratio);

} // namespace glcast::preload
