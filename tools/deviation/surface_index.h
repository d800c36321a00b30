// A mesh in Embree: the nearest point of it, and whether something is in the way. Internal to deviation.
#pragma once
#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <span>

#include "tools/mesh/mesh.h"

namespace glcast {

class SurfaceIndex {
  public:
    struct Nearest {
        double distance = 0; ///< model units
        std::uint32_t triangle = 0;
    };

    enum class Tree {
        good, ///< for many questions
        quick ///< for large meshes: built several times as fast, answers slower
    };
    explicit SurfaceIndex(const Mesh& mesh, Tree tree = Tree::good); ///< `mesh` must outlive this, unchanged

    /// Exact: Embree, in single precision, only leaves out what is surely farther. Of triangles at the same
    /// distance the first, so that the answer does not depend on how the tree was built.
    Nearest nearest(const glm::dvec3& point) const;
    /// The same, sooner where triangle `near` is not far.
    Nearest nearest(const glm::dvec3& point, std::uint32_t near) const;
    /// Of the triangles that face as `normal` does, to less than a right angle, if one is hardly farther than the
    /// nearest of all, which is given: else that one.
    Nearest nearest_facing(const glm::dvec3& point, const glm::dvec3& normal, const Nearest& nearest) const;

    double distance(const glm::dvec3& point, std::uint32_t triangle) const; ///< to one triangle
    std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const {
        const Triangle& t = mesh.triangles[triangle];
        return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    }
    bool faces(std::uint32_t triangle, const glm::dvec3& normal) const; ///< to less than a right angle

    /// Is there a free way from a point of the surface to the far outside in one of the directions? The ray
    /// starts `start_offset` of the diagonal off the surface, along `normal` on the side that the direction
    /// goes to: either side counts, as the triangles may face any way, and the surface there does not hide
    /// itself.
    bool seen(const glm::dvec3& point, const glm::dvec3& normal,
              std::span<const glm::dvec3> directions) const;

    /// 170 times the rounding of single precision in the unit box, so never on the wrong side of the own
    /// triangle; a part nearer than this to another counts as touching it.
    static constexpr double start_offset = 2e-5;

    /// How much farther, of the diagonal, beside as far again as the nearest.
    static constexpr double facing_reach = 5e-3;

  private:
    Nearest search(const glm::dvec3& point, float radius, const glm::dvec3* facing) const;
    float radius_to(const glm::dvec3& point, std::uint32_t triangle) const; ///< for Embree, on the safe side
    static bool visit(RTCPointQueryFunctionArguments* arguments);
    glm::vec3 inside(const glm::dvec3& p) const { return glm::vec3((p - centre) * scale); }

    struct Release {
        void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
        void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
    };
    const Mesh& mesh;
    glm::dvec3 centre{0};
    double scale = 1; ///< to a diagonal of 1
    std::unique_ptr<RTCDeviceTy, Release> device;
    std::unique_ptr<RTCSceneTy, Release> scene;
};

} // namespace glcast
