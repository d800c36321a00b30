#include "tools/mesh/predicates.h"

#include <array>
#include <cmath>
#include <limits>

namespace glcast {
namespace {

constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;
// Bounds of Shewchuk 1997, for differences of the coordinates as they are.
constexpr double bound3 = (7 + 56 * half_ulp) * half_ulp;
constexpr double bound2 = (3 + 16 * half_ulp) * half_ulp;

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// A sum of doubles that do not overlap, smallest first: exact. `most`: how many there can be.
template <int most> struct Expansion {
    std::array<double, most> term;
    int count = 0;

    void push(double x) {
        if (x != 0) term[count++] = x;
    }
    int sign() const { return count ? sign_of(term[count - 1]) : 0; }
};

struct Two {
    double high, low;
};

Two two_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

Two two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

Expansion<2> difference(double a, double b) {
    const Two d = two_sum(a, -b);
    Expansion<2> out;
    out.push(d.low);
    out.push(d.high);
    return out;
}

/// e + x, in place.
template <int most> void grow(Expansion<most>& e, double x) {
    int kept = 0;
    for (int k = 0; k < e.count; ++k) {
        const Two s = two_sum(x, e.term[k]);
        x = s.high;
        if (s.low != 0) e.term[kept++] = s.low;
    }
    e.count = kept;
    e.push(x);
}

template <int m, int n> Expansion<2 * m * n> operator*(const Expansion<m>& a, const Expansion<n>& b) {
    Expansion<2 * m * n> out;
    for (int i = 0; i < a.count; ++i)
        for (int j = 0; j < b.count; ++j) {
            const Two p = two_product(a.term[i], b.term[j]);
            grow(out, p.low);
            grow(out, p.high);
        }
    return out;
}

template <int m, int n> Expansion<m + n> operator-(const Expansion<m>& a, const Expansion<n>& b) {
    Expansion<m + n> out;
    for (int i = 0; i < a.count; ++i) grow(out, a.term[i]);
    for (int j = 0; j < b.count; ++j) grow(out, -b.term[j]);
    return out;
}

template <int m, int n> Expansion<m + n> operator+(const Expansion<m>& a, const Expansion<n>& b) {
    Expansion<m + n> out;
    for (int i = 0; i < a.count; ++i) grow(out, a.term[i]);
    for (int j = 0; j < b.count; ++j) grow(out, b.term[j]);
    return out;
}

int exact3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    Expansion<2> row[3][3];
    const glm::dvec3* point[3] = {&b, &c, &d};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) row[i][k] = difference((*point[i])[k], a[k]);
    const auto minor = [&](int i, int j) { return row[i][0] * row[j][1] - row[i][1] * row[j][0]; };
    return (minor(0, 1) * row[2][2] + minor(1, 2) * row[0][2] + minor(2, 0) * row[1][2]).sign();
}

} // namespace

int orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 u = b - a, v = c - a, w = d - a;
    const double p0 = u.x * v.y, p1 = u.y * v.x, p2 = v.x * w.y, p3 = v.y * w.x, p4 = w.x * u.y,
                 p5 = w.y * u.x;
    const double det = w.z * (p0 - p1) + u.z * (p2 - p3) + v.z * (p4 - p5);
    const double size = (std::abs(p0) + std::abs(p1)) * std::abs(w.z) +
                        (std::abs(p2) + std::abs(p3)) * std::abs(u.z) +
                        (std::abs(p4) + std::abs(p5)) * std::abs(v.z);
    if (std::abs(det) > bound3 * size || size == 0) return sign_of(det);
    return exact3d(a, b, c, d);
}

int orient2d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int drop) {
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    const double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
    const double det = left - right, size = std::abs(left) + std::abs(right);
    if (std::abs(det) > bound2 * size || size == 0) return sign_of(det);
    return (difference(b[x], a[x]) * difference(c[y], a[y]) - difference(b[y], a[y]) * difference(c[x], a[x]))
        .sign();
}

} // namespace glcast
