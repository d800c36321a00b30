// What the captured images show of a surface, for those who look at it after the mesh is made.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "capture/view.h"

namespace glcast {

struct Rays;
struct HitBehind;

/// A point of the captured surface.
struct CapturedPoint {
    glm::dvec3 position{0}; ///< model units
    glm::vec3 colour{0};    ///< as drawn, 0..1
    glm::vec3 normal{0};    ///< unit, as drawn; where none was drawn, that of the surface
    bool found = false;
    bool behind = false; ///< no ray saw the surface: what lies behind its closing of an opening
};

/// Holds every hit of the capture: sixteen bytes a hit, and four a pixel of three images. Cheap to copy.
class CapturedSurface {
  public:
    CapturedSurface() = default; ///< shows nothing
    CapturedSurface(Rays&& rays, const Box& box, bool geometric_normals);

    bool empty() const { return !rays; }
    int resolution() const;          ///< samples along an axis; 0 when empty
    double sample() const;           ///< distance of samples, model units
    glm::dvec3 first_sample() const; ///< where sample (0, 0, 0) is, model units
    /// Sample i of an axis is at coordinate i.
    glm::dvec3 to_samples(const glm::dvec3& position) const;
    /// Widest search by default, samples.
    double default_reach() const { return 2 + resolution() / 16.0; }

    /// The surface near `from`, sought both ways along the line through it with direction `along`: the one
    /// that faces as `facing` does (both unit), not what lies inside the body, and no farther than `reach`
    /// samples. Near an outline, where the line meets nothing, the surface beside `from` as the view that
    /// faces it best has it. Colour and normal are mixed as for vertices: bilinear among pixels whose depth
    /// agrees.
    CapturedPoint find(const glm::dvec3& from, const glm::vec3& along, const glm::vec3& facing,
                       double reach) const;
    /// Its position alone, for half the work: empty where none is found.
    std::optional<glm::dvec3> find_position(const glm::dvec3& from, const glm::vec3& along,
                                            const glm::vec3& facing, double reach) const;
    /// The same for a texture: where the surface closes an opening that nobody drew shut, what lies behind
    /// it, as one sees it who looks in (behind.h).
    CapturedPoint look(const glm::dvec3& from, const glm::vec3& along, const glm::vec3& facing,
                       double reach) const;

  private:
    template <class Seen>
    auto find_from(const glm::dvec3& from, const glm::vec3& along, const glm::vec3& facing, double reach,
                   bool look_behind, const Seen& seen) const;
    CapturedPoint shown_behind(const glm::dvec3& start, const glm::vec3& facing,
                               const HitBehind& there) const; ///< samples
    CapturedPoint seen_at(int axis, const glm::dvec3& at, const glm::vec3& plane, std::uint32_t hit) const;
    glm::dvec3 to_model(const glm::dvec3& at) const { return box.lo + (at + 0.5) * sample(); }
    std::shared_ptr<const Rays> rays;
    Box box;
    bool geometric_normals = false;
};

} // namespace glcast
