// How far two surfaces are apart, measured with Embree (an exact nearest-point query), both ways.
#pragma once
#include <span>

#include "tools/mesh/mesh.h"

namespace glcast {

struct DeviationOptions {
    std::size_t samples =
        200'000;              ///< points per direction, spread by area, plus all vertices and face centres
    bool visible_only = true; ///< leave out points of A and B with no free ray in `directions` directions
    int directions = 200;
};

/// Distances from sampled points of one surface to the other, model units.
struct DistanceStats {
    double mean = 0, rms = 0, p999 = 0, max = 0;
    double normal_mean_degrees =
        0; ///< angle between geometric normals, sign ignored; vertices have none of their own
    std::size_t points = 0, hidden = 0; ///< measured; left out because nobody can see them
};

struct Deviation {
    DistanceStats a_to_b, b_to_a;
    double diagonal_a = 0; ///< of the bounding box of A, to give per cent
};

/// Closed or not, facing any way, with parts inside one another: all that counts is where the triangles are.
/// Throws std::runtime_error when a mesh has no triangles. The same meshes give the same numbers, bit for
/// bit, whatever the number of threads.
Deviation deviation(const Mesh& a, const Mesh& b, const DeviationOptions& options = {});

/// Distance from each point to the nearest point of the surface, model units.
std::vector<double> distances_to(const Mesh& surface, std::span<const glm::dvec3> points);

/// One point of a surface: where, and the unit normal of its triangle (0 where that has no area).
struct SurfacePoint {
    glm::dvec3 position{0}, normal{0};
};

/// `samples` points spread evenly by area, always the same ones.
std::vector<SurfacePoint> sample_by_area(const Mesh& mesh, std::size_t samples);

/// Which points of `mesh` can be seen from far outside in one of `directions` directions (a Fibonacci
/// sphere): 1 or 0.
std::vector<char> visible_points(const Mesh& mesh, std::span<const SurfacePoint> points,
                                 int directions = 200);

} // namespace glcast
