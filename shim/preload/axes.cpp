#include "shim/preload/axes.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "shim/preload/similarity.h"

namespace glcast::preload {
namespace {

bool is_affine(const glm::dmat4& m) {
    return std::abs(m[0][3]) + std::abs(m[1][3]) + std::abs(m[2][3]) < 1e-6 && std::abs(m[3][3] - 1) < 1e-6;
}

/// The orthogonal factor of M = Q H: the rotation (or reflection) nearest to M, so that its columns are the
/// model's axes also where the program scales them differently. Newton's iteration, Higham 1986.
std::optional<glm::dmat3> orthogonal_factor(const glm::dmat3& m) {
    const double size = std::cbrt(std::abs(glm::determinant(m)));
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(m[i][j]));
    if (!(size > 1e-6 * largest) || !std::isfinite(largest)) return std::nullopt;
    glm::dmat3 q = m / size;
    for (int round = 0; round < 100; ++round) {
        const glm::dmat3 next = 0.5 * (q + glm::inverse(glm::transpose(q)));
        double moved = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) moved = std::max(moved, std::abs(next[i][j] - q[i][j]));
        q = next;
        if (moved < 1e-14) break;
    }
    return q;
}

/// Eye space, turned back where the screen shows it mirrored.
glm::dmat4 eye_space(bool mirrored) {
    glm::dmat4 axes(1.0);
    if (mirrored) axes[2][2] = -1;
    return axes;
}

/// The model's axes, its origin and its scale (the mean of three where they differ). Where these are mirrored
/// against the screen, z is turned round: a program that scales by -1 or has left-handed axes means what it
/// shows.
std::optional<glm::dmat4> model_to_eye(const glm::dmat4& modelview, bool mirrored) {
    if (!is_affine(modelview)) return std::nullopt;
    const glm::dmat3 linear(modelview);
    const auto rotation = orthogonal_factor(linear);
    if (!rotation) return std::nullopt;
    glm::dmat3 axes = *rotation * std::cbrt(std::abs(glm::determinant(linear)));
    if ((glm::determinant(axes) < 0) != mirrored) axes[2] = -axes[2];
    glm::dmat4 whole(axes);
    whole[3] = modelview[3];
    return whole;
}

} // namespace

glm::dmat4 choose_eye_to_capture(const ViewAxes& view, const Options& options) {
    if (options.frame_matrix == FrameMatrix::given) return options.given_matrix;
    if (options.frame_matrix == FrameMatrix::eye) return eye_space(view.mirrored);
    if (view.base_modelview) {
        // As it is where it can be: no rounding.
        if (!view.mirrored && is_similarity(*view.base_modelview)) return glm::inverse(*view.base_modelview);
        if (const auto model = model_to_eye(*view.base_modelview, view.mirrored)) return glm::inverse(*model);
    }
    if (options.frame_matrix == FrameMatrix::base)
        throw std::runtime_error("the base modelview has no axes: it flattens or bends space (--frame-matrix base)");
    return eye_space(view.mirrored);
}

} // namespace glcast::preload
