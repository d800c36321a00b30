// Where a draw's vertices come out, asked of GL by feedback: nothing is drawn.
#pragma once
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

class FeedbackProbe {
  public:
    struct Vertex {
        double x, y; ///< window coordinates
        double z, w; ///< clip coordinates
        double s, t; ///< of the texture
    };
    using Polygon = std::vector<Vertex>;

    explicit FeedbackProbe(const GlTable& table) : gl(table) {}

    /// The next draw, up to `end`, makes no fragments. Outside of glBegin.
    void begin();
    bool is_open() const { return open; }
    /// The polygons of the draw, as far as they are in the picture and find room.
    std::vector<Polygon> end();

  private:
    const GlTable& gl;
    std::vector<GLfloat> values;
    bool open = false;
};

/// The texture is seen as its mirror image: it turns the other way in the window. False where nothing is
/// seen.
bool shows_mirrored(const std::vector<FeedbackProbe::Polygon>& polygons);

} // namespace glcast::preload
