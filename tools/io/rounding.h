// What a quantised file keeps of a level. Internal.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast::format {

/// Positions as whole steps of 16 bits from `lo`, the same step along every axis.
struct PositionGrid {
    glm::dvec3 lo{0};
    double step = 1; ///< model units
};
using GridPoint = std::array<std::uint16_t, 3>;

/// The finest that holds all levels.
PositionGrid grid_for(std::span<const Level> levels);

/// The grid point nearest to each position, but no two alike: of vertices that would fall on one, the later
/// take a free one beside it. Rounded positions stay where they are.
std::vector<GridPoint> on_grid(const Mesh& mesh, const PositionGrid& grid);

glm::dvec3 position(const GridPoint& point, const PositionGrid& grid);

std::int8_t signed_byte(float value);      ///< -1..1
std::uint16_t unsigned_short(float value); ///< 0..1
std::array<std::int8_t, 4> tangent_bytes(const glm::vec4& tangent);
float display_byte(float value); ///< the nearest of 256 display values

/// Leaves of the level what the file will hold: positions on the grid, normals and tangents of 8 bits,
/// texture coordinates of 16, colours of 8 (display values).
void round_level(Level& level, const PositionGrid& grid);

} // namespace glcast::format
