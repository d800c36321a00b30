#include "shim/preload/backdrop.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_set>

namespace glcast::preload {
namespace {

constexpr double vast = 16, apart = 5, picture = 1.5;         ///< times as wide as all else
constexpr double sheet_clearance = 1, round_clearance = 0.25; ///< widths of all else
constexpr double flat = 1.0 / 50; ///< of its width: off the plane of a face, and still a sheet or convex
constexpr double in_the_middle = 1.0 / 20, touches = 1.0 / 50; ///< of its width
constexpr double least_share = 1.0 / 3;                        ///< of the width of everything
constexpr std::size_t round_faces = 32, most_points = 256;

glm::dvec3 middle(const Bounds& b) { return (b.lo + b.hi) / 2.0; }

/// Corners of draws, found again where they lie within a grain of one another.
class Corners {
  public:
    explicit Corners(double grain) : grain(grain) {}
    void add(const glm::dvec3& p) { cells.insert(key(cell(p))); }
    bool has(const glm::dvec3& p) const {
        const glm::dvec3 at = cell(p);
        for (int i = 0; i < 27; ++i)
            if (cells.contains(key(at + glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)))) return true;
        return false;
    }
    void clear() { cells.clear(); }

  private:
    glm::dvec3 cell(const glm::dvec3& p) const { return glm::floor(p / grain); }
    static std::size_t key(const glm::dvec3& c) {
        return std::hash<double>()(c.x) * 73856093u ^ std::hash<double>()(c.y) * 19349663u ^
               std::hash<double>()(c.z) * 83492791u;
    }
    const double grain;
    std::unordered_set<std::size_t> cells;
};

/// A plane that the eye is in front of.
struct Face {
    glm::dvec3 normal;
    double offset;
    double in_front(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

struct Piece {
    std::vector<std::size_t> draws;
    std::vector<glm::dvec3> points;
    std::vector<Face> faces;
    Bounds bounds;
    bool textured = true, lit = false;
    bool is_sheet = false;
    double eye_off = 0; ///< between the eye and its middle, along the axes but the worst

    double clearance(const Bounds& rest) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Face& face : faces)
            for (int corner = 0; corner < 8; ++corner)
                least = std::min(least, face.in_front({corner & 1 ? rest.lo.x : rest.hi.x,
                                                       corner & 2 ? rest.lo.y : rest.hi.y,
                                                       corner & 4 ? rest.lo.z : rest.hi.z}));
        return least;
    }
};

std::optional<Face> face_of(const std::vector<glm::dvec3>& polygon, const glm::dvec3& eye) {
    glm::dvec3 normal(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        normal += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    const double length = glm::length(normal);
    if (!(length > 0)) return std::nullopt;
    normal /= length;
    const double offset = glm::dot(normal, polygon[0]);
    return glm::dot(normal, eye) > offset ? Face{normal, offset} : Face{-normal, -offset};
}

std::vector<Piece> pieces_of(const std::vector<DrawShape>& shapes, double grain) {
    std::vector<Piece> pieces;
    Corners corners(grain);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (shapes[i].polygons.empty() || shapes[i].pinned) continue;
        long shared = 0;
        for (const auto& polygon : shapes[i].polygons)
            for (const glm::dvec3& p : polygon) shared += !pieces.empty() && shared < 2 && corners.has(p);
        if (shared < 2) {
            pieces.emplace_back();
            corners.clear();
        }
        Piece& piece = pieces.back();
        piece.draws.push_back(i);
        piece.textured &= shapes[i].textured;
        piece.lit |= shapes[i].lit;
        for (const auto& polygon : shapes[i].polygons)
            for (const glm::dvec3& p : polygon) {
                corners.add(p);
                piece.bounds.add(p);
                piece.points.push_back(p);
            }
    }
    return pieces;
}

/// Is it shaped like a backdrop? Notes its faces.
bool faces_the_eye(Piece& piece, const std::vector<DrawShape>& shapes, const glm::dvec3& eye) {
    const double slack = flat * piece.bounds.width();
    for (const std::size_t draw : piece.draws)
        for (const auto& polygon : shapes[draw].polygons)
            if (const auto face = face_of(polygon, eye)) piece.faces.push_back(*face);
    if (piece.faces.empty()) return false;
    const std::size_t step = 1 + piece.points.size() / most_points;
    piece.is_sheet = true;
    for (const Face& face : piece.faces)
        for (std::size_t i = 0; i < piece.points.size(); i += step) {
            const double front = face.in_front(piece.points[i]);
            if (front < -slack) return false;
            piece.is_sheet &= front <= slack;
        }
    const glm::dvec3 off = glm::abs(eye - middle(piece.bounds));
    piece.eye_off = off.x + off.y + off.z - std::max({off.x, off.y, off.z});
    return true;
}

bool is_behind(const Piece& piece, const glm::dvec3& p) {
    return std::any_of(piece.faces.begin(), piece.faces.end(),
                       [&](const Face& face) { return face.in_front(p) <= 0; });
}

bool is_backdrop(const Piece& piece, const std::vector<Piece>& candidates, const Bounds& rest) {
    const double width = piece.bounds.width(), times = width / rest.width();
    if (is_behind(piece, middle(rest))) return false;
    for (const Piece& other : candidates)
        if (&other != &piece && is_behind(piece, middle(other.bounds))) return false; // walls of a maze
    if (times >= vast) return true;
    const double clearance = piece.clearance(rest);
    if (times >= apart && clearance >= (piece.is_sheet ? sheet_clearance : round_clearance) * rest.width())
        return true;
    if (piece.is_sheet || !piece.textured || piece.lit || times < picture) return false;
    return piece.eye_off <= in_the_middle * width &&
           (piece.faces.size() >= round_faces || clearance >= touches * width);
}

/// Those of the candidates that are, with what is no candidate and what turns out to be none as the rest.
std::vector<Piece> judge(std::vector<Piece> candidates, Bounds rest, double& times) {
    const auto narrower = [](const Piece& a, const Piece& b) { return a.bounds.width() < b.bounds.width(); };
    std::stable_sort(candidates.begin(), candidates.end(), narrower);
    if (rest.is_empty() && !candidates.empty()) {
        rest = candidates.front().bounds;
        candidates.erase(candidates.begin());
    }
    for (;;) {
        const auto none = std::find_if(candidates.begin(), candidates.end(),
                                       [&](const Piece& p) { return !is_backdrop(p, candidates, rest); });
        if (none == candidates.end()) break;
        rest.add(none->bounds);
        candidates.erase(none);
    }
    for (const Piece& piece : candidates) times = std::max(times, piece.bounds.width() / rest.width());
    return candidates;
}

} // namespace

Backdrops find_backdrops(const std::vector<DrawShape>& shapes, const glm::dvec3& eye,
                         const std::function<Bounds()>& others) {
    Backdrops found;
    for (const DrawShape& shape : shapes) found.is_backdrop.push_back(shape.pinned);
    Bounds all;
    for (const DrawShape& shape : shapes)
        for (const auto& polygon : shape.polygons)
            for (const glm::dvec3& p : polygon) all.add(p);
    constexpr double grain = 1.0 / 512;
    std::vector<Piece> pieces = pieces_of(shapes, grain * all.width());
    std::optional<Bounds> beside;
    // What is large beside the widest backdrop may be one once that has gone.
    while (!pieces.empty()) {
        Bounds everything = beside.value_or(Bounds());
        for (const Piece& piece : pieces) everything.add(piece.bounds);
        std::vector<Piece> candidates, rest;
        for (Piece& piece : pieces) {
            const bool may_be = piece.bounds.width() >= least_share * everything.width();
            piece.faces.clear();
            (may_be && faces_the_eye(piece, shapes, eye) ? candidates : rest).push_back(piece);
        }
        if (candidates.empty()) break;
        if (!beside) beside = others();
        Bounds left = *beside;
        for (const Piece& piece : rest) left.add(piece.bounds);
        const std::size_t before = pieces.size();
        for (const Piece& piece : judge(candidates, left, found.times_as_wide))
            for (const std::size_t draw : piece.draws) found.is_backdrop[draw] = true;
        std::erase_if(pieces, [&](const Piece& p) { return found.is_backdrop[p.draws.front()]; });
        if (pieces.size() == before) break;
    }
    if (pieces.empty() && beside.value_or(others()).is_empty())
        found.is_backdrop.assign(shapes.size(), false);
    return found;
}

} // namespace glcast::preload
