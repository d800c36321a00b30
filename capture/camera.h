// The camera in a matrix: how eye space is seen, and where it lies, read from what takes a space to clip
// space.
//
// In perspective a clip position is c = P E p. E is a similarity to eye space, which is the screen's: X
// right, Y up, Z towards the viewer. P has the rows (fx 0 sx 0), (0 fy sy 0), any, (0 0 -1 0). Hence w = -Z,
// and
//
//     X = (x + sx w) / fx      Y = (y + sy w) / fy      Z = -w
//
// The depth row is not used. So draws with other near and far planes, reversed or infinite depth, or another
// field of view have one eye space. With r1, r2, r4 the linear rows of P E and s the scale of E,
//
//     s^2 = r4.r4   sx = -r1.r4 / s^2   fx^2 = r1.r1 / s^2 - sx^2   (y alike)   skew = (r1.r2 / s^2 - sx sy)
//     / (fx fy)
//
// and the skew of a camera is 0. Knows no GL. Matrices are column-major as in GL.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace glcast {

/// How eye space is seen. Perspective: x_ndc = fx X / -Z - sx. Parallel: x_ndc = fx X - sx, z_ndc = -fz Z +
/// constant. fx and fy are negative where a plain projection turns the picture round.
struct Lens {
    bool perspective = true;
    double fx = 1, fy = 1, sx = 0, sy = 0;
    double fz = 1; ///< parallel alone
};

struct Camera {
    Lens lens;
    glm::dmat4 to_eye{1.0}; ///< from the space that the matrix takes to clip space; affine
    bool plain = true;      ///< nothing but a projection, as glFrustum and glOrtho make
};

/// z = slope w + shift of the clip positions: what a depth row is, whatever space they come from.
struct DepthLine {
    double slope = 0, shift = 0;
};

/// The last row is not (0 0 0 1).
bool is_projective(const glm::dmat4& matrix);

/// A plain projection, or one of either kind times a similarity. Nothing where it is no such camera (sheared,
/// oblique, a model that is scaled unevenly) or has no size.
std::optional<Camera> find_camera(const glm::dmat4& to_clip);

/// Perspective times an affine matrix that scales the axes of its space unevenly, the picture's centre being
/// the camera's: the columns stay perpendicular in eye space. Nothing where they say nothing, as along an
/// axis.
std::optional<Camera> find_camera_of_stretched(const glm::dmat4& to_clip);

/// The same matrix under a lens that is known, with whatever affine matrix then stands before it.
/// Perspective.
Camera with_lens(const glm::dmat4& to_clip, const Lens& lens);

/// Of perspective, where rows 3 and 4 are parallel. Of plain parallel projections their depth row.
std::optional<DepthLine> find_depth_line(const glm::dmat4& to_clip);
bool same_line(const DepthLine& a, const DepthLine& b);

/// One eye looks through both: the same centre of the picture and the same shape of pixels, whatever the
/// field of view. Of parallel ones the same frame of the picture.
bool same_eye(const Lens& a, const Lens& b);

/// From the space of `camera` to that of `reference` where one eye sees both; the unit matrix, exactly, where
/// they are the same but for rounding.
std::optional<glm::dmat4> to_space_of(const Camera& reference, const Camera& camera);

/// How much deeper, in depth 0..1, a picture's surfaces are drawn with the depth row `nudged` than with
/// `reference`, where the rows are all but the same: decals that are kept off what they lie on. Else 0.
double depth_nudge(const DepthLine& reference, const DepthLine& nudged, bool perspective);

/// Do pixels of a viewport come out square, to 0.5 %?
bool is_square(const Lens& lens, int width, int height);

/// U: rows that take clip space to eye space, the last one 0. Perspective.
glm::dmat4 clip_to_eye(const Lens& lens);

/// A projection with this lens and depth row.
glm::dmat4 projection_of(const Lens& lens, const DepthLine& depth);

/// Square pixels, and so many degrees from bottom to top.
Lens lens_of_view(double degrees, int width, int height);

/// The picture is the mirror image of the space that the matrix takes.
bool is_mirrored(const Camera& camera);

/// S of M = S R, where S scales the axes of the screen unevenly and R is a rotation: a projection that stands
/// before the view in one matrix. Its rows are perpendicular and its columns are not. S turns hands where M
/// does, in z.
std::optional<glm::dvec3> find_scale_of_rows(const glm::dmat4& matrix);

/// The depth line through points (w, z), where they lie on one and w varies.
class DepthLineFit {
  public:
    void add(double w, double z);
    bool varies() const; ///< w does
    std::optional<DepthLine> line() const;

  private:
    long count = 0;
    double mean_w = 0, mean_z = 0, ww = 0, wz = 0, zz = 0, largest = 0;
    bool behind = false; ///< some w is not positive
};

} // namespace glcast
