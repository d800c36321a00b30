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
    /// 0 is what is seen from outside. Layers 1, 2, ... of `minus` are the hits strictly between the first
    /// (`minus`, layer 0) and the last (`plus`, layer 0) in order of growing depth; `plus` has none but layer
    /// 0.
    int layer = 0;

    bool operator==(const View&) const = default;
};

/// What is known of the hits between the first and the last of each ray.
enum class Layers {
    outer,      ///< nothing: only layer 0
    incomplete, ///< some of them
    complete,   ///< all of them, along all three axes
};

/// How layers beyond the first were found.
enum class LayerMethod {
    none, ///< they were not looked for
    peel, ///< per pixel, by a fragment shader
    slab, ///< by clip planes, a slab of the box at a time
};

inline constexpr int max_layers = 256; ///< parts of one axis and one side

/// The two image axes of a view, column (u) first: x: (y, z), y: (x, z), z: (x, y). The depth axis is the
/// view's.
struct ImageAxes {
    int u, v, depth;
};
constexpr ImageAxes image_axes(Axis axis) {
    constexpr ImageAxes table[] = {{1, 2, 0}, {0, 2, 1}, {0, 1, 2}};
    return table[static_cast<int>(axis)];
}

/// P' of the design: capture frame -> clip space for all views along an axis. Column u of the image grows
/// with axis u, row v with axis v, and depth 0..1 runs through the box along +axis on both sides (no 180
/// degree turn).
glm::dmat4 lattice_projection(const Box& box, Axis axis);

/// The same for a slab of the box: depth 0..1 runs from `near` to `far`, fractions of the box along +axis.
glm::dmat4 lattice_slab_projection(const Box& box, Axis axis, double near, double far);

/// Position in the capture frame of pixel (i, j) of an n x n image at `depth` in 0..1.
glm::dvec3 lattice_point(const Box& box, int n, Axis axis, int i, int j, double depth);

inline constexpr int min_resolution = 8;
inline constexpr int max_resolution = 8192;

} // namespace glcast
