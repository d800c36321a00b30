#include "shim/preload/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace glcast::preload {
namespace {

constexpr double close_around = 1.0 / 4, close_on_one_side = 1.0 / 8; ///< of the width
constexpr double least_room = 1.0 / 100;                              ///< of the width
constexpr double same_place = 1e-5;                                   ///< of the width
constexpr double least_volume = 1.0 / 1000;                           ///< of the cube of the width
constexpr std::size_t most_corners = 64;

using Shown = Draw::Shown;

/// The point of a triangle nearest to p (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
glm::dvec3 nearest_in(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    const glm::dvec3 ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double of_c = d1 * d4 - d3 * d2;
    if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double of_b = d5 * d2 - d1 * d6;
    if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double of_a = d3 * d6 - d5 * d4;
    if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / (d4 - d3 + d5 - d6));
    const double sum = of_a + of_b + of_c;
    return sum != 0 ? a + ab * (of_b / sum) + ac * (of_c / sum) : a;
}

template <class Visit> void for_triangles(const DrawShape& shape, Visit visit) {
    for (const ShapePolygon& polygon : shape.polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i) visit(polygon[0], polygon[i - 1], polygon[i]);
}

struct Piece {
    std::vector<std::size_t> draws;
    Bounds bounds;
    double volume = 0; ///< as if its shown sides were the outer ones
    long triangles = 0;
    Shown shown = Shown::counter_clockwise;
    bool faces_inward() const { return volume < -least_volume * std::pow(bounds.width(), 3); }
};

std::vector<Piece> culled_pieces(const std::vector<DrawShape>& shapes, bool right_handed) {
    const auto is_culled = [](const DrawShape& s) {
        return s.shown == Shown::counter_clockwise || s.shown == Shown::clockwise;
    };
    const auto alike = [](const DrawShape& a, const DrawShape& b) { return a.shown == b.shown; };
    std::vector<Piece> pieces;
    for (const auto& draws : connected_draws(shapes, is_culled, alike)) {
        Piece& piece = pieces.emplace_back();
        piece.draws = draws;
        piece.shown = shapes[draws.front()].shown;
        for (const std::size_t i : draws) piece.bounds.add(bounds_of(shapes[i]));
        const glm::dvec3 about = piece.bounds.middle();
        for (const std::size_t i : draws) {
            const double sign = (shapes[i].shown == Shown::counter_clockwise) == right_handed ? 1 : -1;
            for_triangles(shapes[i], [&](const auto& a, const auto& b, const auto& c) {
                ++piece.triangles;
                piece.volume += sign * glm::dot(a - about, glm::cross(b - about, c - about)) / 6;
            });
        }
    }
    return pieces;
}

bool is_in(const glm::dvec3& p, const Bounds& b) {
    return glm::all(glm::greaterThan(p, b.lo)) && glm::all(glm::lessThan(p, b.hi));
}

bool meet(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThan(a.lo, b.hi)) && glm::all(glm::lessThan(b.lo, a.hi));
}

/// The largest distance from its corners to what is in it.
double farthest(const std::vector<glm::dvec3>& corners, const std::vector<const DrawShape*>& things) {
    double most = 0;
    const std::size_t step = 1 + corners.size() / most_corners;
    for (std::size_t i = 0; i < corners.size(); i += step) {
        double least = std::numeric_limits<double>::infinity();
        for (const DrawShape* thing : things)
            for_triangles(*thing, [&](const auto& a, const auto& b, const auto& c) {
                const glm::dvec3 off = nearest_in(a, b, c, corners[i]) - corners[i];
                least = std::min(least, glm::dot(off, off));
            });
        most = std::max(most, least);
    }
    return std::sqrt(most);
}

/// The same faces, culled the other way: a sheet whose two sides are drawn one after the other.
bool are_two_sides(const Piece& a, const Piece& b) {
    const double close = same_place * a.bounds.width();
    return a.shown != b.shown && a.triangles == b.triangles &&
           glm::all(glm::lessThanEqual(glm::abs(a.bounds.lo - b.bounds.lo), glm::dvec3(close))) &&
           glm::all(glm::lessThanEqual(glm::abs(a.bounds.hi - b.bounds.hi), glm::dvec3(close)));
}

bool is_outline(const Piece& piece, const std::vector<DrawShape>& shapes, const std::vector<bool>& inward,
                const glm::dvec3& eye) {
    if (is_in(eye, piece.bounds)) return false;
    std::vector<const DrawShape*> things;
    Bounds inside;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Bounds bounds = inward[i] ? Bounds() : bounds_of(shapes[i]);
        if (bounds.is_empty() || !meet(bounds, piece.bounds)) continue;
        things.push_back(&shapes[i]);
        inside.add(bounds);
    }
    if (things.empty()) return false;
    std::vector<glm::dvec3> corners;
    for (const std::size_t i : piece.draws)
        for (const ShapePolygon& polygon : shapes[i].polygons)
            corners.insert(corners.end(), polygon.begin(), polygon.end());
    const double width = piece.bounds.width();
    const glm::dvec3 room = glm::min(inside.lo - piece.bounds.lo, piece.bounds.hi - inside.hi);
    const bool all_round = std::min({room.x, room.y, room.z}) > least_room * width;
    return farthest(corners, things) <= (all_round ? close_around : close_on_one_side) * width;
}

} // namespace

std::vector<bool> find_outlines(const std::vector<DrawShape>& shapes, const glm::dvec3& eye,
                                bool right_handed) {
    std::vector<bool> inward(shapes.size(), false), found(shapes.size(), false);
    const std::vector<Piece> pieces = culled_pieces(shapes, right_handed);
    for (const Piece& piece : pieces)
        for (const std::size_t i : piece.draws) inward[i] = piece.faces_inward();
    for (const Piece& piece : pieces) {
        const auto is_side = [&](const Piece& other) { return are_two_sides(piece, other); };
        if (!piece.faces_inward() || std::any_of(pieces.begin(), pieces.end(), is_side) ||
            !is_outline(piece, shapes, inward, eye))
            continue;
        for (const std::size_t i : piece.draws) found[i] = true;
    }
    return found;
}

} // namespace glcast::preload
