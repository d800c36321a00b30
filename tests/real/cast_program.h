// A real program, cast from start to end by the commands that people use: glcast-run, glcast mesh, glcast
// render.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tools/mesh/mesh.h"

namespace glcast::test {

struct RealProgram {
    std::string name; ///< of the files that the cast leaves in the output folder
    std::vector<std::string> command;
    int n = 256;
    std::vector<std::pair<std::string, std::string>> environment = {};
    bool levels = true; ///< false: the full surface only
    std::vector<std::string> options = {}; ///< more of glcast-run's
};

struct Cast {
    std::string name;
    std::string error;                  ///< what went wrong, empty when all went well
    std::string oracle;                 ///< what the independent check says of the mesh
    bool manifold = false;              ///< by the independent check
    std::size_t self_intersections = 0; ///< pairs of triangles of the full surface, as the file holds it
    Mesh mesh;                          ///< level 0
};

/// Files go to the folder `real` of the build tree and stay there: NAME.exr, NAME.glb, NAME.png to look at.
Cast cast_program(const RealProgram& program);

/// Mean distances by `glcast compare`, in samples, in the coordinates of both as they are. Points that nobody
/// can see are left out.
struct Accuracy {
    std::string error;
    double to_truth = 0, from_truth = 0;             ///< mean
    double worst_to_truth = 0, worst_from_truth = 0; ///< of 99.9 % of the points
    double sample = 0;                               ///< model units
};
Accuracy accuracy(const Cast& cast, const Mesh& truth);

/// Share of the surface whose colour is nearest in direction to `colour`.
double area_share(const Mesh& mesh, const glm::vec3& colour);

} // namespace glcast::test
