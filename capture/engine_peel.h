// The fragment shader that peels: a fragment is drawn only if it lies behind the hit found before it on its
// ray and in front of the ray's last. Depth peeling after Everitt 2001, "Interactive Order-Independent
// Transparency".
#pragma once
#include <memory>
#include <vector>

#include "capture/gl/gl_table.h"
#include "capture/pixel_rect.h"

namespace glcast {

/// Two surfaces closer than this count as one hit; in samples, along the ray. Coincident sheets that are
/// tessellated differently differ by the rounding of their vertices and planes, and the steeper they stand to
/// the image the more: so the distance grows with the slope (samples of depth a sample across), which makes
/// it a distance across the surface, but never beyond `most`, so that whatever is taken for one hit lies
/// within half a sample of a hit that stays.
struct SameHit {
    static constexpr float flat = 1.0f / 32, per_slope = 1.0f / 32, most = 0.5f;
};

/// Where the next hit of a pixel is looked for, depths 0..1 through the box.
struct PeelRange {
    float before; ///< the hit before: fragments within SameHit of it are the same
    float passed; ///< fragments up to here were looked at, and are holes of a texture
    float last;   ///< the ray's last hit: fragments within SameHit of it are the same
};

/// A program with a fragment shader only, so the vertex stage stays the fixed one; its texture and it are
/// deleted with the object. The context must be current for as long as it lives.
class PeelShader {
  public:
    /// Null where this OpenGL cannot do it: no GLSL, no float or rectangle textures, or none of n x n.
    static std::unique_ptr<PeelShader> make(const GlTable& gl, int n);
    ~PeelShader();
    PeelShader(const PeelShader&) = delete;
    PeelShader& operator=(const PeelShader&) = delete;

    /// n x n, row 0 is the bottom, of which `only` is taken. Pixel store and transfer state is left at what
    /// it needs.
    void upload(const std::vector<PeelRange>& ranges, const PixelRect& only) const;
    /// The program in use and the texture bound, texture unit 0 active.
    void use() const;

  private:
    PeelShader(const GlTable& gl, int n);
    bool link();
    bool make_texture();

    const GlTable& gl;
    const int n;
    GLint unit = 0; ///< the last one: the program's own textures are on the first
    GLuint program = 0, texture = 0;
};

} // namespace glcast
