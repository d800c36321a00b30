// A surface as points with normals, and the way from a point to it. Internal.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/simplify/attributes.h"

namespace glcast {

/// A point of the surface.
struct Sample {
    glm::dvec3 at{0}, normal{0}; ///< normal: of length 1, or 0
    std::uint32_t start = 0;     ///< vertex of the level where its walk begins
    std::uint32_t on = 0;        ///< vertex of the surface, of the triangle that it lies in
};

/// Finds the nearest of many samples, by a tree of boxes cut at medians (Friedman, Bentley and Finkel 1977).
class SampleTree {
  public:
    /// `spacing`: what samples are apart. They and the walk along their surface must outlive this.
    SampleTree(std::span<const Sample> samples, double spacing, const SurfaceWalk& surface);

    /// From a point to the surface: to the plane of the nearest sample that faces as `facing` (of length 1)
    /// does, if one is hardly farther than the nearest of all. Else, and where `facing` is 0, to the nearest
    /// of all; 0 where that is nearer than samples are apart. Where samples are too far apart to tell, to the
    /// surface itself: by a walk from that sample. `near` is a sample to look at first, and becomes the one
    /// that was found.
    glm::dvec3 way_to_surface(const glm::dvec3& point, const glm::dvec3& facing, std::uint32_t& near) const;

  private:
    struct Box {
        glm::dvec3 low, high;
        double squared_distance(const glm::dvec3& point) const;
    };
    static constexpr std::size_t leaf_size = 8;

    void build(std::size_t node, std::size_t first, std::size_t last);
    double squared(std::uint32_t sample, const glm::dvec3& point) const;
    /// The nearest of those that `counts`, if it is nearer than `near`, at `within` squared.
    template <typename Counts>
    void search(const glm::dvec3& point, std::uint32_t& near, double& within, const Counts& counts) const;

    std::span<const Sample> samples;
    double spacing;
    const SurfaceWalk& surface;
    std::vector<std::uint32_t> order; ///< of samples, leaf by leaf
    std::vector<Box> boxes;           ///< [1] is the root, [k] over [2 k] and [2 k + 1]
};

} // namespace glcast
