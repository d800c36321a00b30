// The paper's tables: what holds of them is asserted; docs/measured/results.md has all figures.
#include <gtest/gtest.h>

#include "tests/paper/originals.h"
#include "tests/paper/tables.h"
#include "tools/mesh/check.h"

namespace glcast::paper {
namespace {

// As printed in Natvig 2006, at 782, 500, 250 and 100 edges.
constexpr double printed_cubes_160[] = {0.031, 0.047, 0.096, 0.118};
constexpr double printed_cubes_40[] = {0.092, 0.121, 0.135, 0.156};

void print(const Table& table) {
    for (const Row& row : table.rows) {
        std::printf("%-12s %8zu triangles, %.5f |", row.name.c_str(), row.triangles, row.error);
        for (const Cell& cell : row.cells) std::printf(" %.5f (%zu)", cell.error, cell.edges);
        std::printf(" | %.2f s, %.2f s\n", row.make_seconds, row.simplify_seconds);
    }
}

/// Each error at most so many times the other row's.
void expect_ratios(const Row& row, const Row& against, const std::vector<double>& most) {
    for (std::size_t k = 0; k < most.size(); ++k)
        EXPECT_LE(row.cells[k].error, most[k] * against.cells[k].error)
            << row.name << " against " << against.name << ", column " << k;
}

void expect_counts_kept(const Table& table) {
    for (const Row& row : table.rows)
        for (std::size_t k = 0; k < table.edges.size(); ++k) {
            EXPECT_LE(row.cells[k].edges, std::size_t(table.edges[k])) << row.name;
            EXPECT_GE(double(row.cells[k].edges), table.edges[k] - 3) << row.name;
        }
}

TEST(Originals, AreWhatTheyShouldBe) {
    const MeshCheck fine = check_mesh(teapot(16)), coarse = check_mesh(teapot(3, true));
    EXPECT_EQ(fine.triangles, 16'384U - 128); // without those that a pole makes flat
    EXPECT_EQ(coarse.edges, 780U);
    for (const MeshCheck& check : {fine, coarse}) {
        EXPECT_EQ(check.components, 4U); // lid, body, handle, spout
        EXPECT_EQ(check.non_manifold_edges + check.non_manifold_vertices + check.degenerate_triangles, 0U);
    }
}

TEST(PaperTableOne, FineTeapotByCollapsesAlone) {
    const Table table = table_one(true, {.levels = Levels::collapsed, .six_views = false});
    print(table);
    expect_counts_kept(table);
    // Targets 1.15, 1, 1, 1. At 100 edges the collapse of one edge more or less moves either by a tenth.
    expect_ratios(table.row("contour 160"), table.row("original"), {1.3, 1, 1, 1.2});
    for (const char* n : {"160", "40"})
        expect_ratios(table.row(std::string("contour ") + n), table.row(std::string("cubes ") + n),
                      {1, 1, 1, 1});
}

TEST(PaperTableOne, FineTeapotFitted) {
    const Table table = table_one(true, {.six_views = false});
    print(table);
    expect_counts_kept(table);
    // Targets 1.15, 1, 1, 1, not met: some of the lid's slit, which the cast closes, can be
    // seen (docs/measured/results.md). These bounds only keep what there is.
    expect_ratios(table.row("contour 160"), table.row("original"), {1.6, 1.2, 1.1, 1.15});
    for (const char* n : {"160", "40"})
        expect_ratios(table.row(std::string("contour ") + n), table.row(std::string("cubes ") + n),
                      {1, 1, 1, 1});
}

TEST(PaperTableOne, CoarseTeapotBeatsThePapersOwnCubes) {
    const Table table = table_one(false, {.six_views = false});
    print(table);
    expect_counts_kept(table);
    EXPECT_LT(table.row("original").cells[0].error, 1e-12);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_LT(table.row("contour 160").cells[k].error, printed_cubes_160[k]) << k;
        EXPECT_LT(table.row("contour 40").cells[k].error, printed_cubes_40[k]) << k;
    }
}

TEST(PaperTableTwo, SpheresAgainstTheirExactUnion) {
    const Table table = table_two({.cubes = false, .six_views = false});
    print(table);
    expect_counts_kept(table);
    expect_ratios(table.row("contour 400"), table.row("union"), {1.05, 1.05, 1.05, 1.05});
}

} // namespace
} // namespace glcast::paper
