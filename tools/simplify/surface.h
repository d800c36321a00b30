// A surface between two rounds of collapses. Internal.
#pragma once
#include <span>

#include "tools/mesh/mesh.h"
#include "tools/simplify/patch.h"

namespace glcast {

/// How long in the unit cube (whose edge is the longest of the mesh's box) a difference of 1 in a colour's
/// channel, and in a component of a normal, counts as a distance of.
struct AttributeWeights {
    double colour = 0, normal = 0;
};

/// The mesh in a unit cube about 0.
struct UnitCube {
    glm::dvec3 centre{0};
    double scale = 1;

    explicit UnitCube(const Mesh& mesh);
    glm::dvec3 inside(const glm::dvec3& p) const { return (p - centre) * scale; }
    glm::dvec3 outside(const glm::dvec3& p) const { return p / scale + centre; }
};

/// What is left of a mesh, in the mesh's own order. A surface with boundaries has triangles to a ghost,
/// `ghost()`.
struct Shape {
    std::vector<glm::dvec3> position; ///< in the unit cube
    std::vector<std::uint32_t> id;    ///< in the mesh
    std::vector<std::uint32_t> source;
    std::vector<char> moved;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> beside; ///< before any round: the last ones of the triangles are to the ghost;
                                       ///< whom each edge looks at

    std::uint32_t ghost() const { return std::uint32_t(position.size()); }
};

template <int N> struct Surface : Shape {
    std::vector<Quadric<N>> quadrics; ///< empty until the first round that hands them on is over
};

/// Closed by triangles to the ghost, behind the others, where it has boundaries.
Shape shape_of(const Mesh& mesh, const UnitCube& cube, bool has_boundaries);

/// Adds what triangle t of the surface says to the quadrics that `quadric_of` gives, or null, for its
/// corners.
template <int N> class TriangleQuadrics {
  public:
    TriangleQuadrics(const Mesh& mesh, const Shape& surface, const AttributeWeights& weights)
        : mesh(mesh), surface(surface), weights(weights),
          own(surface.triangles.size() - surface.beside.size()) {}

    template <typename F> void add(std::size_t t, const F& quadric_of) const {
        Quadric<N> q;
        bool known = false;
        for (const std::uint32_t v : surface.triangles[t]) {
            if (v == surface.ghost()) continue;
            Quadric<N>* sum = quadric_of(v);
            if (!sum) continue;
            if (!known) q = t < own ? of(surface.triangles[t]) : of_boundary(t);
            known = true;
            *sum += q;
        }
    }

  private:
    Quadric<N> of(const Triangle& t) const;
    Quadric<N> of_boundary(std::size_t t) const;
    void add_attributes(Quadric<N>& q, const Triangle& t, const glm::dvec3& doubled_area) const;

    const Mesh& mesh;
    const Shape& surface;
    AttributeWeights weights;
    std::size_t own; ///< triangles; the others are to the ghost
};

/// After the steps, which name vertices of `from`; without quadrics. `became`: for every vertex of `from`,
/// which one it is now.
Shape after_steps(const Shape& from, std::span<const Step> steps, std::vector<std::uint32_t>& became);

} // namespace glcast
