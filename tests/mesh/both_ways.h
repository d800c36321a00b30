// How far a level of detail is from the surface it came from, each way by itself, and what shape it is in.
#pragma once
#include <memory>

#include "tools/mesh/mesh.h"

namespace glcast {
class SurfaceIndex;
}

namespace glcast::test {

/// Distances in model units; over points spread by area, and all vertices for the largest.
struct BothWays {
    struct Way {
        double mean = 0, most = 0;
    };
    Way there, back; ///< from the surface to the level; from the level to the surface
    double most() const { return there.most > back.most ? there.most : back.most; }
    double mean() const { return there.mean > back.mean ? there.mean : back.mean; }
};

/// Measures any number of levels against one surface, which must outlive this.
class BothWaysMeter {
  public:
    BothWaysMeter(const Mesh& surface, std::size_t points);
    ~BothWaysMeter();
    BothWays measure(const Mesh& level) const;

  private:
    const Mesh& surface;
    std::size_t points;
    std::unique_ptr<SurfaceIndex> index;
    std::vector<glm::dvec3> on_surface;
};

/// What a level should have none of.
struct Faults {
    std::size_t crossings = 0; ///< pairs of triangles that meet elsewhere than where they are joined
    std::size_t folds = 0;     ///< edges whose two triangles lie back to back, to less than a degree
    std::size_t slivers = 0;   ///< triangles less than 1e-4 of an equilateral one
};
Faults faults_of(const Mesh& level);

} // namespace glcast::test
