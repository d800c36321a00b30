// One pass: every state that it needs set, the scene drawn through the forced table, once.
#pragma once
#include <array>
#include <glm/mat4x4.hpp>
#include <optional>

#include "capture/engine.h"
#include "capture/engine_target.h"
#include "capture/forced_state.h"

namespace glcast {

class PeelShader;

/// Which fragment of a pixel counts.
enum class DepthRule {
    first,  ///< clear; the first that the side sees
    add,    ///< as `first`, on top of what is there
    equal,  ///< those at the depth that is there, on black; writes no depth, marks its pixels in the stencil
            ///< buffer
    blend,  ///< the same over the colours that are there
    missed, ///< as `first`, where `equal` marked nothing
    unused, ///< no depth test: the program's own stencil
    count,  ///< as `first`, and every fragment, hidden or not, is counted in the stencil buffer
};

enum class Lights {
    none,          ///< ambient only
    signed_colour, ///< six, of positive and negative colour: the normal
    half_colour,   ///< the same for 8-bit targets: 1/2 + normal / 2
    single,        ///< one white light: the positive part of one component
};

struct Pass {
    PassKind kind = PassKind::colour;
    Box box;
    Axis axis = Axis::z;
    Side side = Side::minus;
    DepthRule depth = DepthRule::first;
    Lights lights = Lights::none;
    int light = 0; ///< for `single`: 2 * axis, + 1 for the light from the negative side
    GLenum polygon_mode = GL_FILL;
    double near = 0, far = 1;           ///< depths of the box between which the target's 0..1 lies
    std::optional<PixelRect> only;      ///< the pixels that are cleared and drawn; all where there is none
    const OpenTiles* open = nullptr;    ///< where and how deep something may be found; null: everywhere
    Outline* outline = nullptr;         ///< where only its reach is looked for
    std::optional<Side> viewer;         ///< for whom fronts are fronts, where that is not `side`
    bool culls = false;                 ///< the program's face culling holds
    bool offsets = true;                ///< coplanar surfaces are told apart (depth_offset.h)
    bool outermost = false;             ///< of what is seen from outside; else there may be more in front
    const PeelShader* shader = nullptr; ///< for PassKind::peel
};

/// Draws passes into targets, and counts them.
class PassRunner {
  public:
    PassRunner(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options);
    void run(const Pass& pass, const Target& target);
    int draws() const { return draw_count; }
    /// A peel pass met draws by programs of the program's own, and left them out.
    bool saw_own_program() const { return own_program; }
    /// The last colour pass met fragments that blend, or that come after a further clear of depth: its
    /// colours are final only after a blend pass.
    bool wants_blend_pass() const { return unblended; }

  private:
    void draw_once(const Pass& pass, const Target& target, bool learning);
    void note_places(const Pass& pass, const Target& target);
    void find_masks(const Pass& pass, const Target& target);
    void find_masks_of(Side viewer, const Pass& pass, const Target& target);
    PassFacts facts(const Pass& pass, const Target& target, bool learning);
    Sought sought(const Pass& pass, bool learning) const;
    glm::dmat4 projection(const Pass& pass) const;
    void set_state(const Pass& pass, const Target& target) const;
    void set_depth_rule(const Pass& pass) const;
    void set_matrices(const Pass& pass) const;
    void set_lights(const Pass& pass) const;
    bool mirrored(const Pass& pass) const;

    const GlTable& gl;
    const DrawFunction& draw;
    const glm::dmat4 eye_to_capture;
    const bool mirrored_projection;
    ProgramStencil* const stencil;
    int draw_count = 0;
    bool own_program = false, unblended = false, has_noted_places = false;
    OffsetLevels offset_levels;
    bool offsets_known = false;
    OffsetClamp offset_clamp;
};

} // namespace glcast
