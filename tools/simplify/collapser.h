// The run of edge collapses behind simplify(). Internal.
#pragma once
#include <memory>

#include "tools/mesh/mesh.h"

namespace glcast {

class Collapser {
  public:
    /// What is left of the mesh: `sources` names for every vertex one of the original it came from, near it.
    struct Remainder {
        std::vector<glm::dvec3> positions;
        std::vector<std::uint32_t> sources;
        std::vector<Triangle> triangles;
    };

    /// `mesh` must be a closed two-manifold and must outlive this.
    explicit Collapser(const Mesh& mesh);
    ~Collapser();

    /// Collapse edges, cheapest first, until there are no more than `triangles`, or no edge may collapse.
    void reduce_to(std::size_t triangles);
    std::size_t triangles() const;
    Remainder remainder() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast
