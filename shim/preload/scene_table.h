// A table that numbers the draws which pass through it, and lets through those that its owner keeps.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "capture/gl/override_table.h"
#include "shim/record/record.h"

namespace glcast::preload {

/// Sees each draw as it comes: glBegin, glDraw*, glEvalMesh, glRect.
class DrawGate {
  public:
    explicit DrawGate(const GlTable& gl) : inner(gl) {}
    virtual ~DrawGate() = default;
    DrawGate(const DrawGate&) = delete;
    DrawGate& operator=(const DrawGate&) = delete;

    /// `primitives`: triangles, lines or points, as the mode says; 0 for glBegin, which cannot know yet.
    /// False: the draw is swallowed.
    virtual bool keep(GLenum mode, long primitives) = 0;
    /// A draw that was kept is over.
    virtual void drawn() {}
    /// What glBegin could not know, at its glEnd.
    virtual void add_primitives(long) {}
    /// glPushMatrix is about to be called.
    virtual void before_push() {}
    /// True: clears, pixel rectangles and framebuffer bindings are swallowed too, so nothing at all is drawn.
    virtual bool draws_nothing() const { return false; }
    virtual void framebuffer_bound(GLenum, GLuint) {}
    /// glBlitFramebuffer, which is swallowed always: x0 y0 x1 y1 of both images.
    virtual void blitted(const std::array<GLint, 4>&, const std::array<GLint, 4>&) {}
    /// glClear is about to be called, or would be.
    virtual void cleared(GLbitfield) {}
    /// glDrawPixels, glBitmap or glCopyPixels was called; never solid, and swallowed.
    virtual void pixels_drawn() {}
    /// Some draws are in one colour, whatever their vertices say; and now they are.
    virtual bool may_fix_colour() const { return false; }
    virtual bool fixes_colour() const { return false; }
    /// GL_BLEND is switched. False: the switch is swallowed.
    virtual bool blends(bool) { return true; }
    /// True: glPushAttrib and glPopAttrib bring `blends` back too.
    virtual bool blending_restored() { return false; }

    const GlTable& inner;
    const GlTable& below() const { return inner; }

    // Of the draw that was kept, where it is glDrawArrays or glDrawElements.
    bool as_points = false;                                    ///< its vertices are drawn as GL_POINTS
    std::optional<std::vector<record::DrawParts::Part>> parts; ///< what is drawn of it; nothing: all

    // Of the glBegin that is open; the table's functions keep these.
    bool swallowing = false;
    std::function<void()> late_colour; ///< the last that was swallowed while colours were fixed
    GLenum mode = 0;
    long vertices = 0;
    bool gives_w = false; ///< some vertex had four coordinates
    bool blend = false;
    struct SavedBlend {
        bool is_saved, blend;
    };
    std::vector<SavedBlend> saved_blends;
};

extern const OverrideRules gate_rules;

bool has_faces(GLenum mode);
/// Triangles, lines or points that the vertices make.
long primitive_count(GLenum mode, long vertices);

/// The table through which `gate` sees all. One gate a thread at a time; it must outlive the use of the
/// table.
GlTable gated_table(DrawGate& gate);

} // namespace glcast::preload
