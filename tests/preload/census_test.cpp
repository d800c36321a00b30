// What a user is told about frames that held nothing to cast.
#include "shim/preload/census.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace glcast::preload {
namespace {

using testing::HasSubstr;
using testing::Not;

Census some_frames() {
    Census seen;
    seen.frames = 4;
    return seen;
}

TEST(Census, PointsAndLinesAreOffered) {
    Census seen = some_frames();
    seen.points = 40000;
    EXPECT_THAT(explain(seen), HasSubstr("40000 points; --include points casts these"));
    seen.lines = 8;
    EXPECT_THAT(explain(seen), HasSubstr("--include lines,points casts these"));
}

// Point cloud viewers draw the points by fixed functions and little things around them by shaders.
TEST(Census, ShadersDoNotHideThatTheRestCanBeCast) {
    Census seen = some_frames();
    seen.shaders = 21;
    EXPECT_THAT(explain(seen), HasSubstr("only fixed-function drawing can be cast"));
    EXPECT_THAT(explain(seen), Not(HasSubstr("--include")));
    seen.points = 40000;
    EXPECT_THAT(explain(seen), HasSubstr("--include points casts its points"));
    seen.lines = 8;
    EXPECT_THAT(explain(seen), HasSubstr("--include lines,points casts its lines and points"));
}

TEST(Census, NothingDrawnLeadsToNudge) { EXPECT_THAT(explain(some_frames()), HasSubstr("--nudge")); }

} // namespace
} // namespace glcast::preload
