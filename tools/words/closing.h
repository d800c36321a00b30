// The one line after a cast, for somebody who knows nothing of samples.
#pragma once
#include <string>

namespace glcast {

/// What there is to say of a cast that became a mesh.
struct Closing {
    std::string what;           ///< "glxgears, frame 3"
    std::size_t triangles = 0;  ///< of the level in `file`
    double error_samples = 0;   ///< of that level from what was drawn: 99.9 % of the surface, both ways
    int n = 0;                  ///< samples along each axis of the capture
    std::string file;           ///< where it went
    std::size_t more_files = 0; ///< levels beside it
};

/// "glxgears, frame 3: 44,820 triangles, 0.1 samples from what was drawn (invisible at 256 pixels), in
/// gears.glb, with 3 coarser levels beside it; to look at it: glcast view gears.glb -o gears.html". Safe on a
/// terminal.
std::string closing_line(const Closing& closing);

/// "0.1 samples from what was drawn (invisible at 256 pixels)". An error is invisible while it is at most an
/// eighth of a pixel on the screen; the width is n/2, n/4, ...: more than n/2 pixels a capture is not made
/// for. Natvig 2006, n = 2w.
std::string error_in_words(double samples, int n);

/// The largest width of the object on the screen, n/2 or a half, a quarter, ... of it, at which so large an
/// error is invisible; 0: none of 8 pixels or more.
int invisible_width(double samples, int n);

/// "glcast view gears.glb -o gears.html"
std::string how_to_look(const std::string& file);

} // namespace glcast
