// The framebuffer that the engine draws into and reads from.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "capture/gl/gl_table.h"
#include "capture/pixel_rect.h"

namespace glcast {

/// Square, colour and depth with stencil, the most precise that the driver completes. Deleted with the
/// object; the context must be current for as long as it lives.
class Target {
  public:
    /// `want_float`: floating-point colour when the driver has it, else 8 bits.
    Target(const GlTable& gl, int size, bool want_float);
    ~Target();
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    bool complete() const { return framebuffer_complete; }
    bool float_colour() const { return framebuffer_float; }
    int size() const { return pixels; }

    void bind() const;
    /// size x size values, row 0 is the bottom; those outside of `only` stay as they are, or are 0 where the
    /// vector had another size. Pixel store and transfer state is left at what reading needs.
    void read_depth(std::vector<float>& depth, const std::optional<PixelRect>& only = {}) const;
    void read_colour(std::vector<glm::vec4>& colour, const std::optional<PixelRect>& only = {}) const;
    void read_stencil(std::vector<std::uint8_t>& stencil, const std::optional<PixelRect>& only = {}) const;

  private:
    bool try_formats(GLenum colour_format, GLenum depth_format);
    template <class Value>
    void read(std::vector<Value>& values, const std::optional<PixelRect>& only, GLenum format,
              GLenum type) const;

    const GlTable& gl;
    const int pixels;
    GLuint framebuffer = 0, colour_buffer = 0, depth_buffer = 0;
    bool framebuffer_complete = false, framebuffer_float = false;
};

/// GL_EXTENSIONS has it.
bool has_extension(const GlTable& gl, const char* name);

/// The table with the core names of framebuffer calls filled from EXT_framebuffer_object where a driver has
/// only those.
GlTable with_framebuffer_calls(GlTable gl);
bool has_framebuffer_calls(const GlTable& gl);

/// Largest n that a framebuffer and a viewport can have.
int largest_target(const GlTable& gl);

/// Throw away GL's errors.
void swallow_errors(const GlTable& gl);

} // namespace glcast
