// Surfaces that lie in one another, told apart by glPolygonOffset or a trimmed glDepthRange: decals, tracks
// on a field, edges of a face drawn as thin faces, a body pushed back under its marks. From wherever one
// looks, the one with the lesser offset is seen.
//
// Our views look from elsewhere and measure depth, so the program's own offsets are not used. The offsets in
// a frame become levels, and each level above the deepest is drawn a little nearer to the viewer: much more
// than the rounding that would mix coplanar surfaces pixel by pixel, much less than what peeling takes for
// one hit (SameHit). What is deepest stays where it is, to the bit.
//
// What blends is no surface beside the one below it: it goes a step behind, so that the other shows wherever
// there is one, and the blend pass of the outer views mixes it in over that depth. In inner layers, where
// things that are nearer may not be drawn over, it mixes only where its depth is the same, as without an
// offset. Nor do offsets count in slabs (engine_slab.h).
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast {

inline constexpr float units_of_depth = 1 << 24; ///< of glPolygonOffset, in depth 0..1 of 24 bits

/// The state of a program on which a level depends. GL's defaults.
struct OffsetState {
    bool enabled = false; ///< GL_POLYGON_OFFSET_FILL
    GLfloat factor = 0, units = 0;
    double near = 0, far = 1; ///< glDepthRange
};

/// The offsets with which faces are drawn in a frame.
class OffsetLevels {
  public:
    /// How far back a draw goes, in no unit: only the order counts. `reversed`: the program takes the greater
    /// depth for the nearer.
    static double level_of(const OffsetState& state, bool reversed);

    void note(double level);
    bool several() const { return levels.size() > 1; }
    /// Steps towards the viewer from the deepest level, 0 to `most_steps`. More levels than steps share them.
    int steps(double level) const;

    static constexpr int most_steps = 3;

  private:
    std::vector<double> levels; ///< deepest first, each once
};

/// glPolygonOffsetClamp, or null where the driver has none.
using OffsetClamp = void(APIENTRYP)(GLfloat factor, GLfloat units, GLfloat clamp);

/// How a pass draws a level: `steps` towards the viewer, negative ones away.
struct DepthShift {
    glm::dmat4 projection; ///< without any
    double clip_step = 0;  ///< depth in clip space
    float slope_step = 0;  ///< factor of glPolygonOffset, used where offset_clamp bounds it
    /// Of a face seen edge-on the slope has no end: unbounded, its few pixels go to the sides of the box.
    float slope_most = 0; ///< window depth
    OffsetClamp offset_clamp = nullptr;

    /// `matrix_mode`: the mode to leave.
    void apply(const GlTable& gl, int steps, GLenum matrix_mode) const;
};

/// A step, in samples, and as much again for each sample of depth that a face rises in one across.
inline constexpr double offset_step = 1.0 / 128;

/// Faces steeper than so many samples a sample are drawn no farther forward.
inline constexpr double steepest = 16;

} // namespace glcast
