// A draw moved into the eye space of its group: its modelview matrix is changed for the draw alone, and with
// it what GL keeps in eye space (clip planes, planes of texture coordinates). The projection, lights and all
// else stay as they are.
#pragma once
#include <vector>

#include "capture/gl/gl_table.h"
#include "shim/preload/sight.h"

namespace glcast::preload {

class EyeSpace {
  public:
    explicit EyeSpace(const GlTable& table) : gl(table) {}
    /// Before the draw, outside of glBegin. `nudge`: how much deeper the program draws it than others of the
    /// group.
    void enter(const EyeMap* map, double nudge);
    /// After it.
    void leave();

  private:
    struct Plane {
        bool is_texture;
        GLenum name; ///< clip plane, or coordinate
        GLenum unit;
        GLdouble values[4];
    };
    void move(const EyeMap& map);
    void note_planes();
    void set_planes(const glm::dmat4& space);

    const GlTable& gl;
    bool is_moved = false, is_nudged = false;
    GLint matrix_mode = GL_MODELVIEW;
    glm::dmat4 modelview{1.0};
    std::vector<Plane> planes;
};

} // namespace glcast::preload
