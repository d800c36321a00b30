// What a file of levels of detail holds.
#pragma once
#include <cstdint>
#include <string>

#include "tools/mesh/mesh.h"
#include "tools/mesh/texture.h"
#include "tools/mesh/wedges.h"

namespace glcast {

/// How far a level is from the full surface of the cast: measured over both surfaces, both ways, the larger. Nothing here is an
/// estimate.
struct LevelError {
    double mean = 0, p999 = 0, max = 0; ///< distance, model units; p999: 99.9 % of the points are nearer
    double normal_mean_degrees = 0;     ///< between the normals as shown (of vertices, or of the texture)
    double colour_mean = 0, colour_p999 = 0; ///< largest difference of a channel, display values, 0..1
    double unsupported_area_share = 0;  ///< of the full surface: what no ray saw, 0..1
    double disagreeing_normals_share = 0; ///< of the full surface: where drawn normals are kept that are far off it, 0..1
};

/// Levels of one run that were written together, each to a file.
struct LevelSet {
    std::uint64_t id = 0;
    unsigned level = 0, count = 0; ///< which of how many; count 0: of none
};

/// One level of detail, finest first.
struct Level {
    Mesh mesh;
    std::string name; ///< "gears_LOD0", ...
    LevelError error{}; ///< zero for the full surface, but for its unsupported area, and where it is not known
    double sample = 0; ///< lattice spacing of the capture it was made from, model units; 0 when unknown
    Texture texture{}; ///< empty: colours and normals of vertices or wedges are all there is
    Wedges wedges{};   ///< empty: a normal and a colour a vertex are all there is
    double pixels = 0; ///< width on the screen, of the whole object, that it is made for; 0: for none
    LevelSet set{};
};

} // namespace glcast
