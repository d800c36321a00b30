// How what is drawn into framebuffer objects gets into the window: by blits, and as textures on polygons.
// Direct3D under Wine, and many engines, draw upside down there and turn the picture round on its way.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// Of an image, x0 y0 x1 y1 as glBlitFramebuffer takes them.
using BlitRect = std::array<GLint, 4>;

class WayToWindow {
  public:
    void blit(GLuint from, GLuint to, const BlitRect& source, const BlitRect& target);
    /// A polygon with the texture is drawn into `to`.
    void show_texture(GLuint texture, GLuint to, bool mirrored);

    /// Is the picture of a framebuffer mirrored an odd number of times before it is in the window? Nothing
    /// where it does not get there. `gl`: to ask what is attached.
    std::optional<bool> mirrors(GLuint framebuffer, const GlTable& gl) const;

  private:
    struct Step {
        bool is_texture;
        GLuint from, to;
        bool mirrored;
    };
    std::vector<Step> steps;
};

} // namespace glcast::preload
