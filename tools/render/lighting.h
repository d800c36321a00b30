// Pictures drawn pixel by pixel: what OSMesa's fixed functions cannot, in the same light. Internal.
#pragma once
#include <cstdint>
#include <vector>

#include "tools/render/raster.h"
#include "tools/render/render.h"

namespace glcast {

// The light of every picture: a little over the viewer's shoulder, in eye space.
inline constexpr float ambient_light = 0.35F, diffuse_light = 0.65F;
inline constexpr glm::vec3 towards_light{0.15F, 0.25F, 1};
inline constexpr float tile_grey = 0.95F;

/// A square view along `direction`, y up (along y, z), of what lies within `half` of `centre` to every side.
OrthoView square_view(const glm::dvec3& direction, const glm::dvec3& centre, double half, int pixels);

/// RGBA, row 0 at the bottom, as OSMesa has it. As OSMesa lights: by the normal as it is, also
/// where it was drawn away from the viewer; what has none has no light.
std::vector<std::uint8_t> lit_rgba(const SeenImage& seen, const OrthoView& view);

/// What one of the six views captured, laid into a view along its axis: nearest pixels.
SeenImage resampled(const ViewImage& image, const Box& box, const OrthoView& view);

} // namespace glcast
