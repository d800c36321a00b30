// What a capture looks at: the box, its lattice, and the six views that share it.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace glcast {

/// A cube in the capture frame. Sample i of an axis of an n-lattice sits at lo + (i + 1/2) / n * size, which
/// is a pixel centre of the views along the other two axes.
struct Box {
    glm::dvec3 lo{0};
    double size = 0; ///< edge length, model units, > 0
};

enum class Axis { x = 0, y = 1, z = 2 };

/// The side the camera is on. `minus` looks along +axis and sees the smallest depth of each ray (GL_LESS),
/// `plus` looks along -axis and sees the largest (GL_GREATER). Both have the same projection matrix, so they
/// share every ray.
enum class Side { minus = 0, plus = 1 };

struct View {
    Axis axis = Axis::z;
    Side side = Side::plus;
    int layer = 0; ///< 0 is what is seen from outside

    bool operator==(const View&) const = default;
};

/// The two image axes of a view, column (u) first: x: (y, z), y: (x, z), z: (x, y). The depth axis is the view's.
struct ImageAxes {
    int u, v, depth;
};
constexpr ImageAxes image_axes(Axis axis) {
    constexpr ImageAxes table[] = {{1, 2, 0}, {0, 2, 1}, {0, 1, 2}};
    return table[static_cast<int>(axis)];
}

/// P' of the design: capture frame -> clip space for all views along an axis. Column u of the image grows with
/// axis u, row v with axis v, and depth 0..1 runs through the box along +axis on both sides (no 180 degree turn).
glm::dmat4 lattice_projection(const Box& box, Axis axis);

/// Position in the capture frame of pixel (i, j) of an n x n image at `depth` in 0..1.
glm::dvec3 lattice_point(const Box& box, int n, Axis axis, int i, int j, double depth);

inline constexpr int min_resolution = 8;
inline constexpr int max_resolution = 8192;

} // namespace glcast
