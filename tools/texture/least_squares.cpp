#include "tools/texture/least_squares.h"

#include "tools/texture/conjugate_gradients.h"

namespace glcast {
namespace {

/// What the residuals ask for at rest: the right side of the normal equations.
Vectors pulls(std::span<const Residual> residuals, std::size_t vertices) {
    Vectors sum(vertices, glm::dvec3(0));
    for (const Residual& r : residuals)
        for (int k = 0; k < 3; ++k)
            sum[r.vertices[k]] += r.importance * r.distance * r.weights[k] * r.direction;
    return sum;
}

/// Their matrix times a vector.
Vectors times(std::span<const Residual> residuals, double inertia, const Vectors& x) {
    Vectors sum(x.size());
    for (std::size_t v = 0; v < x.size(); ++v) sum[v] = inertia * x[v];
    for (const Residual& r : residuals) {
        double along = 0;
        for (int k = 0; k < 3; ++k) along += r.weights[k] * glm::dot(r.direction, x[r.vertices[k]]);
        for (int k = 0; k < 3; ++k) sum[r.vertices[k]] += r.importance * along * r.weights[k] * r.direction;
    }
    return sum;
}

} // namespace

std::vector<glm::dvec3> least_squares_moves(std::span<const Residual> residuals, std::size_t vertices,
                                            double inertia) {
    return conjugate_gradients(pulls(residuals, vertices),
                               [&](const Vectors& x) { return times(residuals, inertia, x); });
}

} // namespace glcast
