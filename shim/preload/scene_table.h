// A table that numbers the draws which pass through it, and lets through those that its owner keeps.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// Sees each draw as it comes: glBegin, glDraw*, glEvalMesh, glRect.
class DrawGate {
  public:
    explicit DrawGate(const GlTable& gl) : inner(gl) {}
    virtual ~DrawGate() = default;
    DrawGate(const DrawGate&) = delete;
    DrawGate& operator=(const DrawGate&) = delete;

    /// `polygons`: the primitive has faces; `triangles` of it, unknown yet for glBegin. False: the draw is
    /// swallowed.
    virtual bool keep(bool polygons, long triangles) = 0;
    /// What glBegin could not know, at its glEnd.
    virtual void add_triangles(long) {}
    /// glPushMatrix is about to be called.
    virtual void before_push() {}
    /// True: clears, pixel rectangles and framebuffer bindings are swallowed too, so nothing at all is drawn.
    virtual bool draws_nothing() const { return false; }
    virtual void framebuffer_bound(GLuint) {}

    const GlTable& inner;

    // Of the glBegin that is open; the table's functions keep these.
    bool swallowing = false;
    GLenum mode = 0;
    long vertices = 0;
};

/// Triangles that a primitive is cut into; 0 for points and lines.
long triangle_count(GLenum mode, long vertices);

/// The table through which `gate` sees all. One gate a thread at a time; it must outlive the use of the
/// table.
GlTable gated_table(DrawGate& gate);

} // namespace glcast::preload
