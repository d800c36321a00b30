// Bytes for a page: small, and text. Internal.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "tools/mesh/mesh.h"
#include "tools/view/seams.h"

namespace glcast::view {

using Bytes = std::string;

/// zlib, RFC 1950. Throws std::runtime_error when there is no memory for it.
Bytes deflated(const Bytes& bytes);
/// RFC 4648.
std::string base64(const Bytes& bytes);

/// The cube that positions are rounded in: `lo` is 0, `lo + size` is 65535 (1/128 sample at n = 512).
struct Cube {
    glm::dvec3 lo{0};
    double size = 1;
};

/// The vertices and triangles of a level, deflated. All of one kind follow one another, each as the
/// difference to the one before; `v` is a number in zigzag LEB128, `b` a byte modulo 256:
///
///     x of all vertices (v), y (v), z (v)           65535 = the cube's size
///     distance to level 0 (v)                       65535 = `largest_distance`
///     normals, where there are any: x, y, z (b)     signed, 127 = 1
///     colours, where there are any: r, g, b (b)     display values, 255 = 1
///     coordinates, where textured: u, v (v)         65535 = 1, from the top left
///     tangents, where textured: x, y, z, w (b)      signed, 127 = 1
///     corners of all triangles (v)
///
/// Read by page/levels.js.
Bytes packed_level(const Mesh& mesh, std::span<const double> distance, double largest_distance, const Cube& cube);
Bytes packed_level(const CutMesh& cut, double largest_distance, const Cube& cube);

} // namespace glcast::view
