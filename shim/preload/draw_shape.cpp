#include "shim/preload/draw_shape.h"

#include <cmath>
#include <unordered_set>

namespace glcast::preload {
namespace {

constexpr double grain = 1.0 / 512; ///< of the width of all
constexpr int shared_corners = 2;

/// Corners of draws, found again where they lie within a grain of one another.
class Corners {
  public:
    explicit Corners(double cell_size) : size(cell_size) {}
    void add(const glm::dvec3& p) { cells.insert(key(cell(p))); }
    bool has(const glm::dvec3& p) const {
        const glm::dvec3 at = cell(p);
        for (int i = 0; i < 27; ++i)
            if (cells.contains(key(at + glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)))) return true;
        return false;
    }
    void clear() { cells.clear(); }

  private:
    glm::dvec3 cell(const glm::dvec3& p) const { return glm::floor(p / size); }
    static std::size_t key(const glm::dvec3& c) {
        return std::hash<double>()(c.x) * 73856093u ^ std::hash<double>()(c.y) * 19349663u ^
               std::hash<double>()(c.z) * 83492791u;
    }
    const double size;
    std::unordered_set<std::size_t> cells;
};

bool shares_corners(const DrawShape& shape, const Corners& corners) {
    int shared = 0;
    for (const ShapePolygon& polygon : shape.polygons)
        for (const glm::dvec3& p : polygon)
            if (corners.has(p) && ++shared == shared_corners) return true;
    return false;
}

} // namespace

Bounds bounds_of(const DrawShape& shape) {
    Bounds bounds;
    for (const ShapePolygon& polygon : shape.polygons)
        for (const glm::dvec3& p : polygon) bounds.add(p);
    return bounds;
}

std::vector<std::vector<std::size_t>>
connected_draws(const std::vector<DrawShape>& shapes, const std::function<bool(const DrawShape&)>& wanted,
                const std::function<bool(const DrawShape&, const DrawShape&)>& may_join) {
    Bounds all;
    for (const DrawShape& shape : shapes) all.add(bounds_of(shape));
    std::vector<std::vector<std::size_t>> pieces;
    Corners corners(grain * all.width());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (shapes[i].polygons.empty() || !wanted(shapes[i])) continue;
        const bool joins = !pieces.empty() && may_join(shapes[pieces.back().back()], shapes[i]) &&
                           shares_corners(shapes[i], corners);
        if (!joins) {
            pieces.emplace_back();
            corners.clear();
        }
        pieces.back().push_back(i);
        for (const ShapePolygon& polygon : shapes[i].polygons)
            for (const glm::dvec3& p : polygon) corners.add(p);
    }
    return pieces;
}

} // namespace glcast::preload
