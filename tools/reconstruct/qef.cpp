#include "tools/reconstruct/qef.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace glcast {
namespace {

// Depths are exact to 1e-4 samples, packed normals to 3e-5, so planes that differ by more than some 3 degrees
// are told apart.
constexpr double pull = 2e-3;

using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

/// Minimum of x'Ax/2 - b'x over the coordinates not fixed; A positive definite. `fixed[k]` is 0 (free) or +-1
/// (at a bound).
Row solve(const Matrix& a, const Row& b, const std::array<int, 3>& fixed, const Row& lo, const Row& hi) {
    Row x{};
    int free[3], count = 0;
    for (int k = 0; k < 3; ++k) {
        if (fixed[k])
            x[k] = fixed[k] < 0 ? lo[k] : hi[k];
        else
            free[count++] = k;
    }
    double m[3][4];
    for (int i = 0; i < count; ++i) {
        m[i][3] = b[free[i]];
        for (int k = 0; k < 3; ++k)
            if (fixed[k]) m[i][3] -= a[free[i]][k] * x[k];
        for (int j = 0; j < count; ++j) m[i][j] = a[free[i]][free[j]];
    }
    for (int i = 0; i < count; ++i)
        for (int r = i + 1; r < count; ++r) {
            const double factor = m[r][i] / m[i][i];
            for (int j = i; j < count; ++j) m[r][j] -= factor * m[i][j];
            m[r][3] -= factor * m[i][3];
        }
    for (int i = count - 1; i >= 0; --i) {
        double value = m[i][3];
        for (int j = i + 1; j < count; ++j) value -= m[i][j] * x[free[j]];
        x[free[i]] = value / m[i][i];
    }
    return x;
}

double energy(const Matrix& a, const Row& b, const Row& x) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        sum -= 2 * b[i] * x[i];
        for (int j = 0; j < 3; ++j) sum += a[i][j] * x[i] * x[j];
    }
    return sum;
}

bool within(const Row& x, const Row& lo, const Row& hi) {
    for (int k = 0; k < 3; ++k)
        if (!(x[k] >= lo[k] - 1e-9 && x[k] <= hi[k] + 1e-9)) return false;
    return true;
}

/// The lowest point of all faces, edges and corners of the box: at most 26 small systems, and rarely needed.
Row best_on_boundary(const Matrix& a, const Row& b, const Row& lo, const Row& hi) {
    Row best = lo;
    double least = energy(a, b, best);
    for (int code = 1; code < 27; ++code) {
        const std::array<int, 3> fixed{code % 3 == 2 ? -1 : code % 3, code / 3 % 3 == 2 ? -1 : code / 3 % 3,
                                       code / 9 == 2 ? -1 : code / 9};
        const Row x = solve(a, b, fixed, lo, hi);
        if (!within(x, lo, hi)) continue;
        const double e = energy(a, b, x);
        if (e < least) {
            least = e;
            best = x;
        }
    }
    return best;
}

} // namespace

void Quadric::add(const glm::vec3& point, const glm::vec3& normal, float weight) {
    const double d = glm::dot(point, normal), x = normal.x, y = normal.y, z = normal.z;
    a[0] += weight * x * x;
    a[1] += weight * x * y;
    a[2] += weight * x * z;
    a[3] += weight * y * y;
    a[4] += weight * y * z;
    a[5] += weight * z * z;
    b[0] += weight * x * d;
    b[1] += weight * y * d;
    b[2] += weight * z * d;
    c += weight * d * d;
    add(point, weight);
}

void Quadric::add(const glm::vec3& point, float weight) {
    points += point * weight;
    weights += weight;
}

float Quadric::distance(const glm::vec3& x) const {
    const Matrix planes{Row{a[0], a[1], a[2]}, Row{a[1], a[3], a[4]}, Row{a[2], a[4], a[5]}};
    return float(std::sqrt(std::max(0.0, energy(planes, {b[0], b[1], b[2]}, {x.x, x.y, x.z}) + c)));
}

glm::vec3 Quadric::minimum(const glm::vec3& lo, const glm::vec3& hi) const {
    const glm::vec3 m = mean();
    const Matrix full{Row{a[0] + pull, a[1], a[2]}, Row{a[1], a[3] + pull, a[4]},
                      Row{a[2], a[4], a[5] + pull}};
    const Row right{b[0] + pull * m.x, b[1] + pull * m.y, b[2] + pull * m.z};
    const Row low{lo.x, lo.y, lo.z}, high{hi.x, hi.y, hi.z};
    Row x = solve(full, right, {0, 0, 0}, low, high);
    if (!within(x, low, high)) x = best_on_boundary(full, right, low, high);
    return {float(x[0]), float(x[1]), float(x[2])};
}

} // namespace glcast
