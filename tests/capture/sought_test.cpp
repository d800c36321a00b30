// Which faces a pass need not draw.
#include "capture/sought.h"

#include <gtest/gtest.h>

namespace glcast {
namespace {

constexpr int n = 16;
const Box box{{0, 0, 0}, n}; // pixel i of an image is at i + 1/2

Place flat_at(const glm::dvec3& lo, const glm::dvec3& hi) {
    return {lo, hi, {INFINITY, INFINITY, 1}, {0, 0, 1}};
}

TEST(OpenTiles, AFaceBetweenTheCentresOfPixelsHasNoFragments) {
    OpenTiles tiles(box, Axis::z, n);
    tiles.open_all();
    EXPECT_FALSE(tiles.cover_of(flat_at({3.6, 3.6, 4}, {4.4, 4.4, 4})));
    EXPECT_FALSE(tiles.cover_of(flat_at({3.6, 3.2, 4}, {4.4, 4.9, 4})));
    const auto cover = tiles.cover_of(flat_at({3.2, 3.2, 4}, {3.8, 4.6, 4}));
    ASSERT_TRUE(cover);
    EXPECT_EQ(std::make_pair(cover->u0, cover->u1), std::make_pair(std::int16_t(3), std::int16_t(3)));
    EXPECT_EQ(std::make_pair(cover->v0, cover->v1), std::make_pair(std::int16_t(3), std::int16_t(4)));
    EXPECT_TRUE(tiles.meet(*cover));
}

TEST(OpenTiles, WhatADriverMayMoveOntoACentreCounts) {
    const OpenTiles tiles(box, Axis::z, n);
    EXPECT_TRUE(tiles.cover_of(flat_at({3.55, 3.3, 4}, {4.4, 4.4, 4})));
}

TEST(OpenTiles, OnlyDepthsThatAreLookedForAreMet) {
    OpenTiles tiles(box, Axis::z, n);
    const auto cover = tiles.cover_of(flat_at({3, 3, 4}, {4, 4, 4}));
    ASSERT_TRUE(cover);
    EXPECT_FALSE(tiles.meet(*cover));
    tiles.open(3 * n + 3, 0.5f, 0.75f);
    EXPECT_FALSE(tiles.meet(*cover));
    tiles.open(3 * n + 3, 0.2f, 0.3f);
    EXPECT_TRUE(tiles.meet(*cover));
    tiles.close_all();
    EXPECT_FALSE(tiles.meet(*cover));
    tiles.open_all();
    EXPECT_TRUE(tiles.meet(*cover));
}

TEST(Outline, LeavesOutWhatLiesInsideOfAllAndOfWhatWasSeen) {
    const glm::dvec3 lo{4, 4, 4}, hi{12, 12, 12}, nothing(INFINITY);
    const Place inside = flat_at({7, 7, 7}, {8, 8, 7}), at_the_side = flat_at({4, 7, 7}, {5, 8, 7});
    Outline outline(box, Axis::z, n, nothing, -nothing);
    EXPECT_TRUE(outline.leave_out(inside, lo, hi));
    EXPECT_FALSE(outline.leave_out(at_the_side, lo, hi));
    EXPECT_TRUE(outline.is_enclosed({4, 4, 4}, {12, 12, 12}));
    EXPECT_FALSE(outline.is_enclosed({7, 4, 4}, {12, 12, 12}));
    // What reaches beyond, and may be invisible, is no reason to leave out what was not seen to be enclosed.
    Outline by_sight(box, Axis::z, n, {7.5, 4, 4}, {12, 12, 12});
    EXPECT_FALSE(by_sight.leave_out(inside, lo, hi));
}

TEST(Outline, LeavesOutNothingWhereAllMayBeCut) {
    const glm::dvec3 nothing(INFINITY);
    Outline outline(box, Axis::z, n, nothing, -nothing);
    EXPECT_FALSE(outline.leave_out(flat_at({7, 7, 7}, {8, 8, 7}), {0.5, 4, 4}, {12, 12, 12}));
}

} // namespace
} // namespace glcast
