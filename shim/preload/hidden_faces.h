// Hidden-line drawing: faces are drawn into the depth buffer alone, and lines over them. The window shows the
// faces in the colour that it was cleared to, so that is their colour in a cast.
#pragma once
#include <array>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// Around draws of such faces.
class HiddenFaces {
  public:
    explicit HiddenFaces(const GlTable& table) : gl(table) {}

    /// Unlit, untextured and unblended, in this colour; the colours of vertices must not reach GL meanwhile.
    void enter(const std::array<GLfloat, 4>& background);
    void leave();
    bool entered() const { return is_entered; }

  private:
    const GlTable& gl;
    bool is_entered = false;
};

} // namespace glcast::preload
