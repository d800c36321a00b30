#include "tools/simplify/separation.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace glcast {
namespace {

using Points = std::span<const glm::dvec3>;

struct Reach {
    double least, most;
};

Reach along(const glm::dvec3& axis, Points points) {
    Reach reach{dot(axis, points[0]), 0};
    reach.most = reach.least;
    for (const glm::dvec3& p : points.subspan(1)) {
        const double at = dot(axis, p);
        reach.least = std::min(reach.least, at);
        reach.most = std::max(reach.most, at);
    }
    return reach;
}

glm::dvec3 normal(const std::array<glm::dvec3, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// Without a common corner; both relative to a point near them.
bool apart(const std::array<glm::dvec3, 3>& s, const std::array<glm::dvec3, 3>& t, double distance) {
    const auto parts = [&](const glm::dvec3& axis) {
        const Reach a = along(axis, s), b = along(axis, t);
        const double gap = std::max(a.least - b.most, b.least - a.most);
        return gap > 0 && gap * gap > distance * distance * dot(axis, axis);
    };
    const glm::dvec3 of_s = normal(s), of_t = normal(t);
    if (parts(of_s) || parts(of_t)) return true;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (parts(cross(s[(i + 1) % 3] - s[i], t[(j + 1) % 3] - t[j]))) return true;
    for (std::size_t i = 0; i < 3; ++i) // in one plane
        if (parts(cross(of_s, s[(i + 1) % 3] - s[i])) || parts(cross(of_t, t[(i + 1) % 3] - t[i])))
            return true;
    return false;
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 middle_of(const std::array<glm::dvec3, 2>& angle) {
    return angle[0] * glm::length(angle[1]) + angle[1] * glm::length(angle[0]);
}

/// Does the plane of one side of each angle have the others on either hand?
bool parts_by_sides(const glm::dvec3& s, const glm::dvec3& other_s, const glm::dvec3& t,
                    const glm::dvec3& other_t, double distance) {
    constexpr double least_sine = 1e-9; // else the sides may be one
    const glm::dvec3 axis = cross(s, t);
    const double length = glm::length(axis), far = distance * length;
    if (length <= least_sine * glm::length(s) * glm::length(t)) return false;
    const double at_s = dot(axis, other_s), at_t = dot(axis, other_t);
    return (at_s > far && at_t < -far) || (at_s < -far && at_t > far);
}

/// With one: the two other corners of each, relative to it. A point of both would make all points between it
/// and the common corner common, so that it is enough to part the angles there.
bool apart(const std::array<glm::dvec3, 2>& s, const std::array<glm::dvec3, 2>& t, const Nearness& nearness) {
    const auto parts = [&](const glm::dvec3& axis) {
        const double length = glm::length(axis), far = nearness.distance * length,
                     none = nearness.rounding * length;
        const Reach a = along(axis, s), b = along(axis, t);
        return (a.least > far && b.most <= none) || (a.least >= -none && b.most < -far) ||
               (b.least > far && a.most <= none) || (b.least >= -none && a.most < -far);
    };
    if (parts(unit(middle_of(s)) - unit(middle_of(t))))
        return true; // angles in one plane whose sides are in line, too
    const glm::dvec3 of_s = cross(s[0], s[1]), of_t = cross(t[0], t[1]);
    if (parts(of_s) || parts(of_t)) return true;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            if (parts_by_sides(s[i], s[1 - i], t[j], t[1 - j], nearness.distance)) return true;
    for (std::size_t i = 0; i < 2; ++i)
        if (parts(cross(of_s, s[i])) || parts(cross(of_t, t[i]))) return true;
    return false;
}

/// With two: the edge, and the third corner of each relative to its beginning.
bool apart(const glm::dvec3& edge, const glm::dvec3& s, const glm::dvec3& t, double distance) {
    const glm::dvec3 normal = cross(edge, s), inwards = cross(normal, edge);
    const double off = dot(normal, t);
    return off * off > distance * distance * dot(normal, normal) || dot(inwards, t) < 0;
}

} // namespace

bool are_apart(const Facet& first, const Facet& second, const Nearness& nearness) {
    Facet s = first, t = second; // common corners to the front
    std::size_t common = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = common; j < 3; ++j)
            if (s.corners[i] == t.corners[j]) {
                std::swap(s.corners[i], s.corners[common]), std::swap(s.at[i], s.at[common]);
                std::swap(t.corners[j], t.corners[common]), std::swap(t.at[j], t.at[common]);
                ++common;
                break;
            }
    const glm::dvec3 origin = s.at[0];
    for (std::size_t k = 0; k < 3; ++k) s.at[k] -= origin, t.at[k] -= origin;
    switch (common) {
    case 0:
        return apart(s.at, t.at, nearness.distance);
    case 1:
        return apart(std::array{s.at[1], s.at[2]}, std::array{t.at[1], t.at[2]}, nearness);
    case 2:
        return apart(s.at[1], s.at[2], t.at[2], nearness.distance);
    default:
        return false;
    }
}

} // namespace glcast
