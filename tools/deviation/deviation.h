// How far two surfaces are apart, measured with Embree (an exact nearest-point query), both ways.
#pragma once
#include "tools/mesh/mesh.h"

namespace glcast {

struct DeviationOptions {
    std::size_t samples = 200'000; ///< points per direction, spread by area, plus all vertices and face centres
    bool visible_only = true;      ///< leave out points of A and B with no free ray in `directions` directions
    int directions = 200;
};

/// Distances from sampled points of one surface to the other, model units.
struct DistanceStats {
    double mean = 0, rms = 0, p999 = 0, max = 0;
    double normal_mean_degrees = 0; ///< angle between geometric normals, sign ignored
    std::size_t points = 0, hidden = 0; ///< measured; left out because nobody can see them
};

struct Deviation {
    DistanceStats a_to_b, b_to_a;
    double diagonal_a = 0; ///< of the bounding box of A, to give per cent
};

Deviation deviation(const Mesh& a, const Mesh& b, const DeviationOptions& options = {});

} // namespace glcast
