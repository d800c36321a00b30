// What the program would have set, where what we set instead depends on it.
#pragma once
#include <vector>

#include "capture/coincident.h"
#include "capture/depth_offset.h"
#include "capture/gl/gl_table.h"
#include "capture/stencil_rule.h"

namespace glcast {

enum class PassKind {
    colour,  ///< depth, and the colour of what stays there; also what the box is found with
    blend,   ///< what blends with the colours that are there (coincident.h)
    normal,  ///< normals as colours
    peel,    ///< depth alone, by a fragment shader of ours (engine_peel.h)
    stencil, ///< the program's own stencil buffer, and nothing else (program_stencil.h)
};

/// Alpha that the normal pass writes: lit, drawn with lighting off, nothing drawn.
inline constexpr float lit_alpha = 1.0f, unlit_alpha = 0.5f, missed_alpha = 0.0f;

/// What a pass knows beside its kind. `depth`: the depth function that it has set; with GL_EQUAL the stencil
/// buffer counts what was drawn, by a rule that goes by the draw; else by `stencil`.
struct PassFacts {
    PassKind kind = PassKind::colour;
    GLenum depth = GL_LESS;
    StencilRule stencil;
    bool viewer_at_plus = false; ///< the greater depth is the nearer
    bool culls = false;          ///< the program's face culling holds
    bool outermost = false;      ///< no surface is in front of what is drawn
    DepthShift shift;
    const OffsetLevels* levels = nullptr; ///< of the frame; null where offsets count for nothing
    OffsetLevels* learnt = nullptr;       ///< where they are noted, if they are
};

/// The program's values of the state that is tracked, and GL's attribute stack of them. Everything else that
/// the forced table keeps lives in GL itself, where PushAttrib and PopAttrib take care of it.
class ForcedState {
  public:
    ForcedState(const GlTable& real, const PassFacts& pass);

    /// One set of values, at GL's defaults.
    struct Values {
        bool colour_material = false, alpha_test = false;
        GLenum colour_material_face = GL_FRONT_AND_BACK, colour_material_mode = GL_AMBIENT_AND_DIFFUSE;
        GLenum alpha_function = GL_ALWAYS;
        GLclampf alpha_reference = 0;
        FragmentState fragments;
        OffsetState offset;
        struct {
            GLboolean red = GL_TRUE, green = GL_TRUE, blue = GL_TRUE, alpha = GL_TRUE;
        } colour_mask;
        bool buffer_shows = true; ///< colours reach a buffer at all
        bool own_program = false; ///< a program of the program's is in use; noted in peel passes
        GLenum matrix_mode = GL_MODELVIEW;
    };
    Values program;
    bool saw_own_program = false; ///< what was drawn by it is missing
    bool saw_blending = false;    ///< the colours are not yet what the program would leave
    int depth_clears = 0;

    bool culls() const { return pass.culls; }
    void push(GLbitfield mask); ///< call before GL's own
    void pop();                 ///< call after GL's own

    void apply_alpha() const;           ///< alpha test, from alpha test, blending and what is shown
    void apply_order();                 ///< which of the fragments at one depth stay, and how they mix
    void apply_offset();                ///< how near its level is drawn
    void apply_fragments();             ///< all three
    void apply_colour_material() const; ///< colour pass only
    void apply_lighting() const;        ///< normal pass only: white when lit, black when not
    void apply();                       ///< all of them
    /// A draw begins or ends that is cast only where the program's stencil test passes. `masked`: the highest
    /// bit of the stencil buffer tells where; else it passes everywhere.
    void keep_to_mask(bool on, bool masked);
    /// The program clears: what that means where depths are equal.
    void cleared(GLbitfield buffers);
    /// The program draws faces, or may. Those that nobody sees, as in a pass for depth alone, are no level.
    void note_faces();

  private:
    struct Saved {
        GLbitfield mask;
        Values values;
    };
    bool shows() const;
    void order_by_depth() const;
    void order_by_stencil() const;
    void apply_stencil(const StencilRule& rule) const { rule.apply(real, masked); }
    int steps_nearer() const;
    bool mixes_over_others() const;
    double level() const;

    const GlTable& real;
    const PassFacts pass;
    const PassKind kind;
    const GLenum depth;
    int shifted = 0; ///< steps that are in force
    bool masked = false;
    std::size_t stack_limit = 16;
    std::vector<Saved> stack;
};

/// What a material parameter becomes in the colour pass, set by glMaterial or tracked by glColorMaterial;
/// GL_NONE: nothing that the pass looks at.
GLenum mapped_material(GLenum name);

} // namespace glcast
