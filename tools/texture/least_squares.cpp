#include "tools/texture/least_squares.h"

#include <glm/geometric.hpp>

namespace glcast {
namespace {

using Vectors = std::vector<glm::dvec3>;

constexpr int most_steps = 60;
constexpr double enough = 1e-8; // of the squared gradient

double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += glm::dot(a[v], b[v]);
    return sum;
}

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
    Vectors x(vertices, glm::dvec3(0)), rest = pulls(residuals, vertices), search = rest;
    double now = dot(rest, rest);
    const double last = enough * now;
    for (int step = 0; step < most_steps && now > last; ++step) {
        const Vectors image = times(residuals, inertia, search);
        const double length = now / dot(search, image);
        for (std::size_t v = 0; v < vertices; ++v) {
            x[v] += length * search[v];
            rest[v] -= length * image[v];
        }
        const double next = dot(rest, rest);
        for (std::size_t v = 0; v < vertices; ++v) search[v] = rest[v] + next / now * search[v];
        now = next;
    }
    return x;
}

} // namespace glcast
