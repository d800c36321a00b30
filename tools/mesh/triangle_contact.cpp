#include "tools/mesh/triangle_contact.h"

#include <utility>

#include "tools/mesh/predicates.h"

namespace glcast {
namespace {

using Point = glm::dvec3;

/// Corners of a triangle with those it shares in front.
struct Corners {
    const Point* at[3];
    const Point& operator[](int k) const { return *at[k]; }
};

bool between(double a, double x, double b) { return a <= b ? a <= x && x <= b : b <= x && x <= a; }

/// p lies on the line through a and b (seen along `drop`): is it between them?
bool on_segment(const Point& a, const Point& b, const Point& p, int drop) {
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    return between(a[x], p[x], b[x]) && between(a[y], p[y], b[y]);
}

bool segments_meet_seen_along(int drop, const Point& a, const Point& b, const Point& c, const Point& d) {
    const int abc = orient2d(a, b, c, drop), abd = orient2d(a, b, d, drop);
    const int cda = orient2d(c, d, a, drop), cdb = orient2d(c, d, b, drop);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && on_segment(a, b, c, drop)) || (abd == 0 && on_segment(a, b, d, drop)) ||
           (cda == 0 && on_segment(c, d, a, drop)) || (cdb == 0 && on_segment(c, d, b, drop));
}

/// In one plane. Segments apart are seen apart along some axis.
bool coplanar_segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    for (int drop = 0; drop < 3; ++drop)
        if (!segments_meet_seen_along(drop, a, b, c, d)) return false;
    return true;
}

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    return orient3d(a, b, c, d) == 0 && coplanar_segments_meet(a, b, c, d);
}

/// An axis along which the triangle is seen with an area, or -1.
int open_axis(const Corners& t) {
    for (int drop = 0; drop < 3; ++drop)
        if (orient2d(t[0], t[1], t[2], drop) != 0) return drop;
    return -1;
}

/// Convex, in one plane: apart when a line along an edge of the triangle or along the segment has them
/// strictly on either side.
bool coplanar_segment_meets(const Corners& t, const Point& p, const Point& q) {
    const int drop = open_axis(t);
    if (drop < 0) { // no area: its edges
        for (int k = 0; k < 3; ++k)
            if (segments_meet(t[k], t[(k + 1) % 3], p, q)) return true;
        return false;
    }
    const int turn = orient2d(t[0], t[1], t[2], drop);
    for (int k = 0; k < 3; ++k) {
        const Point &a = t[k], &b = t[(k + 1) % 3];
        if (turn * orient2d(a, b, p, drop) < 0 && turn * orient2d(a, b, q, drop) < 0) return false;
    }
    const int first = orient2d(p, q, t[0], drop);
    return !(first && orient2d(p, q, t[1], drop) == first && orient2d(p, q, t[2], drop) == first);
}

/// `side_p`, `side_q`: where p and q lie from the triangle's plane.
bool segment_meets(const Corners& t, const Point& p, const Point& q, int side_p, int side_q) {
    if (side_p * side_q > 0) return false;
    if (side_p == 0 && side_q == 0) return coplanar_segment_meets(t, p, q);
    int most = 0, least = 0;
    for (int k = 0; k < 3; ++k) {
        const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
        most |= side > 0;
        least |= side < 0;
        if (most && least) return false;
    }
    return true;
}

int side(const Corners& t, const Point& p) { return orient3d(t[0], t[1], t[2], p); }

/// Without a common vertex.
bool meet(const Corners& s, const Corners& t) {
    int of_t[3], of_s[3];
    for (int k = 0; k < 3; ++k) of_t[k] = side(s, t[k]);
    if (of_t[0] && of_t[0] == of_t[1] && of_t[0] == of_t[2]) return false;
    for (int k = 0; k < 3; ++k) of_s[k] = side(t, s[k]);
    if (of_s[0] && of_s[0] == of_s[1] && of_s[0] == of_s[2]) return false;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        if (segment_meets(s, t[k], t[next], of_t[k], of_t[next])) return true;
        if (segment_meets(t, s[k], s[next], of_s[k], of_s[next])) return true;
    }
    return false;
}

/// Corner 0 is common: what they share besides it ends on the edge opposite to it of one of them.
bool meet_besides_vertex(const Corners& s, const Corners& t) {
    return segment_meets(s, t[1], t[2], side(s, t[1]), side(s, t[2])) ||
           segment_meets(t, s[1], s[2], side(t, s[1]), side(t, s[2]));
}

/// Corners 0 and 1 are common.
bool folded(const Corners& s, const Corners& t) {
    if (side(s, t[2]) != 0) return false;
    for (int drop = 0; drop < 3; ++drop)
        if (orient2d(s[0], s[1], s[2], drop) * orient2d(s[0], s[1], t[2], drop) > 0) return true;
    return false;
}

} // namespace

bool triangles_meet(std::span<const glm::dvec3> positions, const Triangle& first, const Triangle& second) {
    Triangle s = first, t = second;
    int common = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = common; j < 3; ++j)
            if (s[i] == t[j]) {
                std::swap(s[i], s[common]);
                std::swap(t[j], t[common++]);
                break;
            }
    const Corners a{&positions[s[0]], &positions[s[1]], &positions[s[2]]};
    const Corners b{&positions[t[0]], &positions[t[1]], &positions[t[2]]};
    switch (common) {
    case 0:
        return meet(a, b);
    case 1:
        return meet_besides_vertex(a, b);
    case 2:
        return folded(a, b);
    default:
        return true;
    }
}

} // namespace glcast
