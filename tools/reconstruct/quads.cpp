#include "tools/reconstruct/quads.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <tbb/parallel_for.h>

#include "tools/reconstruct/crossings.h"
#include "tools/reconstruct/patches.h"
#include "tools/reconstruct/vertices.h"

namespace glcast {
namespace {

constexpr double level = 2e-3;     // samples: both diagonals pass the crossing at the same height
constexpr double clearance = 4e-4; // samples that a quad must keep from the sides of its envelope

std::uint32_t vertex_of(const Cell& cell, int edge) {
    return cell.first + patch_table().patch[cell.config][cell.flipped][edge];
}

int edge_index(int axis, int corner) {
    for (int k = 0; k < 4; ++k)
        if (edge_corner(4 * axis + k) == corner) return 4 * axis + k;
    throw std::logic_error("no such edge");
}

/// Twice the area of abc seen along the axis (b and c are the next axes).
double area_along(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, int b, int c) {
    return (q[b] - p[b]) * (r[c] - p[c]) - (q[c] - p[c]) * (r[b] - p[b]);
}

/// A quad about a lattice edge: corners counter-clockwise seen from +axis.
struct Quad {
    /// Its cells: bit 0 is one back in b, bit 1 one back in c.
    static constexpr int around[4] = {3, 2, 0, 1};
    glm::dvec3 corner[4];
    int axis;
    glm::dvec3 low; ///< the edge's lower end, samples

    /// Height along the axis at which the split along diagonal d, d + 2 meets the edge, and whether its two
    /// triangles face the same way.
    bool split(int d, double& height) const {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const glm::dvec3 &p = corner[d], &q = corner[d + 1], &r = corner[d + 2], &s = corner[(d + 3) % 4];
        const bool fair = area_along(p, q, r, b, c) > 1e-6 && area_along(p, r, s, b, c) > 1e-6;
        const glm::dvec3& third = area_along(p, r, low, b, c) > 0 ? s : q;
        const double all = area_along(p, r, third, b, c);
        if (std::abs(all) < 1e-9) {
            height = 0.5 * (p[axis] + r[axis]);
            return fair;
        }
        const double at_third = area_along(p, r, low, b, c) / all,
                     at_r = area_along(p, low, third, b, c) / all;
        height = at_third * third[axis] + at_r * r[axis] + (1 - at_third - at_r) * p[axis];
        return fair;
    }

    /// How far the corners are outside their cells along an axis at most; negative when all are inside.
    double stray() const {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        double most = -1;
        for (int k = 0; k < 4; ++k) {
            glm::dvec3 in = corner[k] - low - 0.5;
            in[b] += around[k] & 1;
            in[c] += around[k] >> 1;
            most = std::max({most, std::abs(in.x), std::abs(in.y), std::abs(in.z)});
        }
        return most - 0.5;
    }

    /// Are both triangles in the envelope of Ju and Udeshi 2006, the tetrahedra of the lattice edge and each
    /// side of the quad? Corners in their cells: the one triangle that the edge pierces is; the other is when
    /// the diagonal passes between it and the edge within the triangle that the edge and its third corner
    /// make.
    bool in_envelope(int d, double clearance) const {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const glm::dvec3 p = corner[d] - low, r = corner[d + 2] - low, edge(0);
        const double side = area_along(p, r, edge, b, c);
        const glm::dvec3 s = (side > 0 ? corner[d + 1] : corner[(d + 3) % 4]) - low;
        const double all = side - area_along(p, r, s, b, c);
        if (!(std::abs(all) > 1e-9)) return false;
        const double t = side / all, along = area_along(p, edge, s, b, c);
        const double whole = along - area_along(r, edge, s, b, c);
        if (!(std::abs(whole) > 1e-9)) return false;
        const double height = p[axis] + along / whole * (r[axis] - p[axis]) - t * s[axis];
        return t < 1 - clearance && height > clearance && height < 1 - t - clearance;
    }
};

/// 0 or 1: the corner where the better diagonal starts. It is the one that passes nearer to the crossing.
int better_diagonal(const Quad& quad, const Crossing& crossing) {
    double height[2];
    const bool fair[2] = {quad.split(0, height[0]), quad.split(1, height[1])};
    if (fair[0] != fair[1]) return fair[1];
    if (crossing.supported && std::abs(height[0] - height[1]) > level)
        return std::abs(height[1] - crossing.at) < std::abs(height[0] - crossing.at);
    const glm::dvec3 first = quad.corner[2] - quad.corner[0], second = quad.corner[3] - quad.corner[1];
    return glm::dot(second, second) < glm::dot(first, first) - 1e-9;
}

class Layer {
  public:
    Layer(const EdgeCrossings& crossings, const CellGrid& grid, const std::vector<glm::dvec3>& positions,
          double rounding)
        : crossings(crossings), grid(grid), positions(positions), clear(clearance + 2 * rounding) {}
    void run(int z, Triangle* to, std::uint32_t* first_quad) {
        out = to;
        made = std::uint32_t(grid.quad_start[z]);
        for (int y = 0; y <= grid.n; ++y) {
            first_quad[y] = made;
            run_row(y, z);
        }
    }
    std::size_t unsupported = 0;
    std::vector<std::uint32_t> suspects;
    double stray = 0;
    double area = 0, unsupported_area = 0;

  private:
    void run_row(int y, int z) {
        // rows[i]: bit 0 of i is one back in y, bit 1 one back in z
        RowCursor rows[4] = {{grid, y, z}, {grid, y - 1, z}, {grid, y, z - 1}, {grid, y - 1, z - 1}};
        for (std::size_t i = grid.row_start[grid.row(y, z)]; i < grid.row_start[grid.row(y, z) + 1]; ++i) {
            const Cell& cell = grid.cells[i];
            for (RowCursor& row : rows) row.forward(cell.x - 1);
            const int corner = cell.config & 1;
            for (int axis = 0; axis < 3; ++axis)
                if (owns_quad(cell, axis)) add_quad(rows, cell.x, y, z, axis, corner);
        }
    }

    void add_quad(const RowCursor (&rows)[4], int x, int y, int z, int axis, bool low_filled) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const auto low = cell_sample(x, y, z, 0);
        std::uint32_t vertex[4];
        Quad quad{{}, axis, glm::dvec3(low[0], low[1], low[2])};
        bool suspect = false;
        for (int k = 0; k < 4; ++k) {
            const int corner = (Quad::around[k] & 1) << b | (Quad::around[k] >> 1) << c;
            const Cell& cell = rows[corner >> 1].cell(x - (corner & 1));
            vertex[k] = vertex_of(cell, edge_index(axis, corner));
            quad.corner[k] = positions[vertex[k]];
            suspect |= patch_table().count[cell.config][cell.flipped] > 1;
        }
        const Crossing crossing = crossings[made];
        unsupported += !crossing.supported;
        const int d = better_diagonal(quad, crossing);
        const double outside = quad.stray();
        stray = std::max(stray, outside);
        if (suspect || outside > -clear || !quad.in_envelope(d, clear)) suspects.push_back(made);
        ++made;
        Triangle triangles[2] = {{vertex[d], vertex[d + 1], vertex[d + 2]},
                                 {vertex[d], vertex[d + 2], vertex[(d + 3) % 4]}};
        double size = 0;
        for (Triangle& triangle : triangles) {
            const glm::dvec3& corner = positions[triangle[0]];
            size += glm::length(glm::cross(positions[triangle[1]] - corner, positions[triangle[2]] - corner));
            if (!low_filled) std::swap(triangle[1], triangle[2]);
            *out++ = triangle;
        }
        area += size;
        if (!crossing.supported) unsupported_area += size;
    }

    const EdgeCrossings& crossings;
    const CellGrid& grid;
    const std::vector<glm::dvec3>& positions;
    const double clear;
    Triangle* out = nullptr;
    std::uint32_t made = 0;
};

} // namespace

std::vector<Triangle> make_triangles(const EdgeCrossings& crossings, const CellGrid& grid,
                                     const std::vector<glm::dvec3>& positions, double rounding,
                                     QuadReport& report) {
    std::vector<Triangle> triangles(2 * grid.quad_start.back());
    report = {};
    report.crossings = grid.quad_start.back();
    report.first_quad.resize(grid.row_start.size());
    report.first_quad.back() = std::uint32_t(report.crossings);
    std::vector<Layer> layers(grid.n + 1, Layer(crossings, grid, positions, rounding));
    tbb::parallel_for(0, grid.n + 1, [&](int z) {
        layers[z].run(z, triangles.data() + 2 * grid.quad_start[z], &report.first_quad[grid.row(0, z)]);
    });
    double area = 0, unsupported_area = 0;
    for (const Layer& layer : layers) {
        area += layer.area;
        unsupported_area += layer.unsupported_area;
        report.unsupported += layer.unsupported;
        report.stray = std::max(report.stray, float(layer.stray));
        report.suspects.insert(report.suspects.end(), layer.suspects.begin(), layer.suspects.end());
    }
    report.unsupported_area_share = area > 0 ? unsupported_area / area : 0;
    return triangles;
}

} // namespace glcast
