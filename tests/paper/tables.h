// Tables 1 and 2 of the paper, measured.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tests/paper/cast.h"
#include "tests/paper/error.h"
#include "tools/deviation/deviation.h"
#include "tools/simplify/simplify.h"

namespace glcast::paper {

/// How levels are made: by collapses alone, as the paper's progressive meshes are, or fitted afterwards.
enum class Levels { collapsed, fitted };

struct Cell {
    std::size_t edges = 0; ///< that are left
    double error = 0;      ///< the paper's measure, model units
    double symmetric = 0;  ///< the larger of the mean distances there and back
};

struct Row {
    std::string name;
    std::size_t triangles = 0; ///< before it is simplified
    double error = 0;          ///< before it is simplified
    std::vector<Cell> cells;   ///< by the table's counts of edges
    double make_seconds = 0, simplify_seconds = 0;
    double peak_megabytes = 0; ///< while it was simplified
};

struct Table {
    std::vector<double> edges;
    std::size_t original_edges = 0, points = 0, hidden_points = 0;
    std::vector<Row> rows;
    const Row& row(const std::string& name) const; ///< throws std::out_of_range
};

struct TableOptions {
    Levels levels = Levels::fitted;
    bool symmetric = false; ///< measure both ways too; takes most of the time
    bool cubes = true;
    bool six_views = true; ///< rows "contour, six views, 160" too: the paper's rule instead of all layers
};

/// Rows "original", "contour 160", "cubes 160", "contour 40", "cubes 40"; 782, 500, 250, 100 edges.
/// `fine`: the teapot of 16 x 16 squares a patch; otherwise one of 780 edges.
Table table_one(bool fine, const TableOptions& options);

/// Rows "union" and "contour 400", and "cubes 400"; 5000, 500, 250, 100 edges.
Table table_two(const TableOptions& options);

/// Highest resident memory since `forget_peak_memory`, megabytes (Linux).
double peak_megabytes();
void forget_peak_memory();

} // namespace glcast::paper
