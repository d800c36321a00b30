// Where each chart lies in the atlas.
#pragma once
#include <stdexcept>

#include "tools/texture/charts.h"

namespace glcast {

struct Atlas {
    int size = 0;       ///< texels along an edge
    int gutter = 0;     ///< texels between charts, and twice what lies between a chart and the atlas's edge
    double density = 0; ///< texels a model unit
    struct Place {
        int x = 0, y = 0, width = 0, height = 0; ///< texels that the chart touches, without gutter
        glm::dvec2 shift{
            0}; ///< texel of a point p: in_picture(p) * density + shift; texel centres are at halves
    };
    std::vector<Place> places; ///< by chart
};

/// The charts of a level do not fit an atlas, however coarse.
struct AtlasTooSmall : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The smallest atlas, 64, 128, ... up to `largest` texels wide, that holds the charts at `density` with that gutter;
/// else as pack() does with the largest.
Atlas pack_tightly(const Charts& charts, int largest, int gutter, double density, const glm::dvec3& origin);

/// Packs with the largest density, up to `finest`, that fits, and a gutter of `gutter` texels, or where
/// charts are too many for that, with a smaller one down to 2. Where `finest` fits, texel centres lie on
/// whole multiples of 1 / finest from `origin`. Throws AtlasTooSmall when they do not fit at all.
Atlas pack(const Charts& charts, int size, int gutter, double finest, const glm::dvec3& origin);

} // namespace glcast
