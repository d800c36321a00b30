// Tangents as MikkTSpace makes them (Mikkelsen 2008, "Simulation of wrinkled surfaces revisited";
// mikktspace.c).
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "tools/texture/neighbours.h"

namespace glcast {

/// A tangent per corner, as Texture::tangents has them. Corners of one vertex share theirs where their
/// triangles are joined by edges within one chart. Needs mesh.normals.
std::vector<std::array<glm::vec4, 3>> make_tangents(const Mesh& mesh, const Neighbours& neighbours,
                                                    const std::vector<std::uint32_t>& chart_of,
                                                    const std::vector<std::array<glm::vec2, 3>>& coordinates);

} // namespace glcast
