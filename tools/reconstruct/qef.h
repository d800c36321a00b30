// Where planes meet: quadratic error of Garland and Heckbert 1997 as used by Ju et al. 2002, regularised and
// bounded.
#pragma once
#include <glm/vec3.hpp>

namespace glcast {

/// Sum of weighted squared distances to planes plus `pull` times the squared distance to the mean of the
/// points.
class Quadric {
  public:
    /// A point of the surface; `normal` unit length, weight > 0.
    void add(const glm::vec3& point, const glm::vec3& normal, float weight);
    /// A point whose plane is unknown.
    void add(const glm::vec3& point, float weight);
    /// The minimum within lo..hi (exact: the constrained problem, not a clipped free one).
    glm::vec3 minimum(const glm::vec3& lo, const glm::vec3& hi) const;
    /// Root of the sum of weighted squared distances of x to the planes.
    float distance(const glm::vec3& x) const;
    glm::vec3 mean() const { return points / weights; }

  private:
    double a[6] = {}; ///< xx xy xz yy yz zz
    double b[3] = {};
    double c = 0;
    glm::vec3 points{0};
    float weights = 0;
};

} // namespace glcast
