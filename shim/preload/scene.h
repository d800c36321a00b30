// Which draws of a recorded frame belong together: those that one camera sees through one viewport into one
// framebuffer, with whatever near and far planes and field of view (capture/camera.h). One group is cast
// (choice.h says which).
//
// The eye space of a group is that of its first draw. Where the matrices of another draw make another one,
// its modelview matrix is changed while it is drawn (eye_space.h). In a frame with one projection nothing is.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/gl/gl_table.h"
#include "capture/program_stencil.h"
#include "capture/sought.h"
#include "capture/view.h"
#include "shim/preload/draw_places.h"
#include "shim/preload/options.h"
#include "shim/preload/sight.h"
#include "shim/preload/stencil_events.h"
#include "shim/record/record.h"

namespace glcast::preload {

enum class ProjectionKind {
    perspective,
    orthographic, ///< with the depth test on
    flat,         ///< orthographic without: overlays, text, backgrounds
};

struct Group {
    GLuint framebuffer = 0;
    GLint draw_buffer = 0;
    std::array<GLint, 4> viewport{};
    glm::dmat4 projection{1.0}; ///< of its first draw
    ProjectionKind kind = ProjectionKind::flat;
    std::optional<Camera> camera;   ///< in the first draw's matrices
    std::optional<DepthLine> depth; ///< likewise
    /// Its eye space is the screen's, for that of the first draw is scaled unevenly, or the modelview holds
    /// the projection.
    bool in_screen_space = false;
    /// S^-1 where the program's modelview begins with a scale S that belongs to the projection, as glOrtho in
    /// it is.
    glm::dmat4 unscale{1.0};
    /// Those that its draws are seen by, each once, a few at most; from the group's eye space.
    std::vector<glm::dmat4> projections;
    bool depth_reversed = false; ///< the greater depth is in front
    bool turned_round = false;   ///< mirrored on its way to the window (way_to_window.h)
    bool guessed_view =
        false; ///< the program hands over clip coordinates, and nobody tells its field of view
    long judged_by_function = 0; ///< draws of faces that blend by their colours alone (capture/solidity.h)
    long with_own_w = 0;         ///< draws of vertices with a w of their own that could not be understood
    bool erased = false;         ///< a clear of the whole viewport came after: nothing of it is seen
    long draws = 0;              ///< of any primitive
    long last_draw = -1;         ///< index into Scene::draws
    long triangles = 0;          ///< filled
    long outlined = 0;           ///< triangles drawn as lines or points by glPolygonMode
    long lines = 0, points = 0;
    bool writes_depth = false;           ///< any filled draw
    long hidden_triangles = 0;           ///< filled, drawn into the depth buffer alone
    std::array<GLfloat, 4> background{}; ///< what the window is cleared to
    /// Of open draws; [1]: of those that mirror.
    std::array<long, 2> open_triangles{};
    /// Draws of faces that show only at a depth which is there already; only at greater depths than are
    /// there, where a stencil test lets them.
    long at_equal_depth = 0, at_greater_depth = 0;
    /// What the model's axes are taken from: the modelview at the first glPushMatrix before the group's first
    /// draw that finds more than an identity, else the modelview of that draw. Draws under a stencil test,
    /// which may be reflections, count only where there are no others.
    std::optional<glm::dmat4> base_modelview;
    bool base_is_stencilled = false;

    /// Faces that only hide what is behind them, and lines over them.
    bool is_hidden_line() const {
        return hidden_triangles > 0 && open_triangles[0] + open_triangles[1] == 0 &&
               outlined + lines + points > 0;
    }
    /// Drawn in space, not on the screen.
    bool is_spatial() const { return kind != ProjectionKind::flat; }
    bool same_place(const Group& other) const;
    /// Its picture in its framebuffer is the mirror image of its eye space.
    bool is_mirrored() const;
};

/// What one draw of the frame is.
struct Draw {
    int group = 0; ///< index into Scene::groups
    enum class Kind { filled, outlined, line, point } kind = Kind::filled;
    /// The sides of its faces that culling leaves: all, those that are counter-clockwise or clockwise in the
    /// window.
    enum class Shown : std::uint8_t { both, counter_clockwise, clockwise, none } shown = Shown::both;
    bool tests_depth = false, writes_depth = false;
    bool writes_colour = true; ///< some channel of it
    bool before_depth = false; ///< nothing of the group had written depth yet
    bool stencilled = false;   ///< kept to some places by a stencil test
    bool is_open = false;      ///< seen wherever it is in front: not stencilled, writes colour and depth
    bool hides = false;        ///< filled, drawn into the depth buffer alone
    bool mirrors = false;      ///< its modelview turns right hands into left ones
    bool textured = false, lit = false;
    bool pinned = false;      ///< the depth range leaves it the far plane alone
    bool left_out = false;    ///< a backdrop or an outline (left_out.h)
    long triangles = 0;       ///< or lines, or points
    int eye_map = -1;         ///< index into Scene::eye_maps; -1: it lies in the group's eye space as it is
    bool two_colours = false; ///< its fronts and its backs are lit with materials of their own
    bool lit_on_both = false, lit_as_front = false; ///< light turns the normals of its backs; does not
    GLenum culled = GL_NONE;                        ///< its faces that are not drawn
    StencilUse stencil;                             ///< as planned (stencil_plan.h)
    bool is_outline = false;                        ///< around the picture of something (stencil_plan.h)
    bool is_decal = false;                          ///< on a surface, without a depth test
    double nudge = 0; ///< how much deeper than the group its projection draws it (capture/camera.h)
};

struct Scene {
    std::vector<Group> groups; ///< in the order of their first draws
    std::vector<Draw> draws;   ///< in the order of the frame
    std::vector<EyeMap> eye_maps;
    std::vector<StencilEvent> stencil_events;
    bool window_has_stencil = true; ///< or it is not known
    long pixels = 0;                ///< rectangles of pixels
};

/// Draws with which a program cuts solids out of one another in the depth buffer before it draws `group`:
/// faces behind others in the same projection, to whatever buffer, where the group then shows what has the
/// depth that was left (OpenCSG; Goldfeather et al. 1989, "Near real-time CSG rendering using tree
/// normalization and geometric pruning"). 0 where the group is not drawn so.
long cutting_draws(const std::vector<Scene>& scenes, const Group& group);

/// Replays the frame in the current context without drawing anything. `view_angle`: degrees from bottom to
/// top, for what is handed over in clip coordinates.
Scene analyse(const record::Frame& frame, const GlTable& gl, std::optional<double> view_angle = std::nullopt);

/// Which draws of a group are played.
struct Wanted {
    /// Its filled draws, or the outlined ones where it has none. Of a group that writes depth, what neither
    /// tests nor writes it is not solid (overlays), nor what was drawn before and wrote none (skies,
    /// backgrounds). Nor are reflections: draws that a stencil test keeps to a mirror, their modelview of the
    /// other hand than that of most which needs no stencil.
    bool solid = true;
    bool lines = false, points = false;
    bool everything = false; ///< as the program draws it
    bool backdrops = false;  ///< too: skies, backgrounds, outlines
    bool marks = false;      ///< glPassThrough of -1 - (index into Scene::draws) before each draw
    const std::vector<std::uint8_t>* only = nullptr; ///< by index into Scene::draws: those that are not 0
    Transparent transparent = Transparent::by_alpha;
    /// Where draws are cast only where their stencil test passes: told of each draw. Not with `everything`.
    ProgramStencil* stencil = nullptr;
};

/// A draw that a stencil test keeps to a mirror.
bool is_reflection(const Draw& draw, const Group& group);
/// Is it one of the draws of its group that are cast? `backdrops`: these too.
bool is_solid(const Draw& draw, const Group& of, bool backdrops);

/// How the solid draws of a group tell fronts from backs.
struct Sides {
    bool coloured = false; ///< lit with materials of their own
    bool culled = false;   ///< fronts and backs of the same are drawn one after the other
    bool lit_on_both = false, lit_as_front = false; ///< as in Draw

    void add(const Sides& more);
    /// They must be drawn each by itself.
    bool are_apart() const { return coloured || culled || (lit_on_both && lit_as_front); }
    /// They look alike, but that the normal of a back is the reverse of the front's.
    bool are_reversed() const { return lit_on_both && !are_apart(); }
};
Sides sides_of(const Scene& scene, int group);

/// Replays the frame, but of its draws only some of one group, and of these only what may be sought. `places`
/// is of this frame; null: all is drawn.
void replay_group(const record::Frame& frame, const Scene& scene, int group, const Wanted& wanted,
                  const GlTable& gl, const Sought& sought = {}, DrawPlaces* places = nullptr);

/// "3360 triangles in 12 draws, perspective, viewport 0 0 800 600".
std::string describe(const Group& group);

/// Where the group is seen from, in the capture frame; far away where all rays are parallel. Nothing when the
/// projection has no inverse.
std::optional<glm::dvec3> eye_of(const Group& group, const glm::dmat4& eye_to_capture);

/// A cube around the group's view volume in the capture frame, its far plane taken no further than
/// `far_ratio` times as far away from the eye as its near plane. Nothing when the projection has no inverse.
std::optional<Box> view_volume(const Group& group, const glm::dmat4& eye_to_capture, double far_ratio);

} // namespace glcast::preload
