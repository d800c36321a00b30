// What the frames of a program held, so that people can be told why none was cast.
#pragma once
#include <string>

namespace glcast::preload {

/// Of one frame or of many.
struct Census {
    long frames = 0;
    long foreign_frames = 0; ///< drawn by contexts of OpenGL ES
    long solid = 0;          ///< filled or outlined triangles in depth-tested or perspective drawing
    long flat = 0;           ///< the other triangles
    long masked = 0;         ///< of `solid`, those drawn with masked colours into the depth buffer alone
    long see_through = 0;    ///< of `solid`, those that blending lets the background through
    long lines = 0, points = 0;
    long pixels = 0;            ///< glDrawPixels, glBitmap, glCopyPixels
    long shaders = 0;           ///< draws under GLSL or assembly programs
    bool told_of_older = false; ///< the program is told of an older OpenGL without shaders (pretence.h)
    std::string no_such_group;  ///< a line that says which groups there are instead of the one asked for
    std::string other_windows; ///< none of the windows is the one asked for: a line that says which there are
    std::string refused;       ///< why a frame could not be recorded, the last such reason

    Census& operator+=(const Census& other);
    /// One bit for each kind that was seen.
    unsigned kinds() const;
};

/// "of lines (1,200): try --include lines", "drawn with OpenGL ES, ...": what was seen instead of a solid,
/// and what to do.
std::string explain(const Census& seen);

} // namespace glcast::preload
