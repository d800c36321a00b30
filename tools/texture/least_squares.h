// Moves of a mesh's vertices that fulfil many linear wishes as well as it goes. Internal.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace glcast {

/// A point of a triangle, or of an edge (the third weight is 0), should move so far along a direction.
struct Residual {
    std::array<std::uint32_t, 3> vertices;
    glm::dvec3 weights{0};   ///< barycentric
    glm::dvec3 direction{0}; ///< unit
    double distance = 0;
    double importance = 0;
};

/// The move of each of so many vertices with the least sum of importance times square of what is left, plus
/// `inertia` times squared moves. The same bits on any number of threads.
std::vector<glm::dvec3> least_squares_moves(std::span<const Residual> residuals, std::size_t vertices,
                                            double inertia);

} // namespace glcast
