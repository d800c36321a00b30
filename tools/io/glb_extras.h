// What a .glb says of its levels beside their triangles. Internal.
#pragma once
#include <span>
#include <tiny_gltf.h>

#include "tools/mesh/level.h"

namespace glcast::format {

/// `extras` of a mesh: triangles, the measured errors (error_names), sample, pixels, the mark of its set.
tinygltf::Value level_extras(const Level& level);
void read_extras(const tinygltf::Value& extras, Level& level); ///< whatever of it is there

/// A number of an object; `otherwise` where it is missing, or no number.
double number_in(const tinygltf::Value& object, const char* name, double otherwise = 0);

/// MSFT_screencoverage: for each level the least share of the screen's area, taken up by the sphere round the
/// model, at which it is drawn rather than the next. Level k may be drawn while its error, 99.9 % of the
/// surface, is less than a pixel of a screen of 1920 x 1080; where it was never measured, while its triangles
/// are not larger on the screen than level 0's when that fills it. The last is 0: the model never vanishes.
std::vector<double> screen_coverage(std::span<const Level> levels);

} // namespace glcast::format
