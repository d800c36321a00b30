// Which of several framebuffers is the scene, where none of them is the window's.
#include <gtest/gtest.h>

#include "shim/preload/choice.h"

namespace glcast::preload {
namespace {

Candidate group(GLuint framebuffer, ProjectionKind kind, long triangles, long last_draw) {
    Candidate candidate;
    candidate.group.framebuffer = framebuffer;
    candidate.group.kind = kind;
    candidate.group.triangles = triangles;
    candidate.group.last_draw = last_draw;
    candidate.group.viewport = {0, 0, 640, 480};
    return candidate;
}

GLuint best_framebuffer(std::vector<Candidate> candidates) {
    rank(candidates, Include{}, false, [](const Candidate&) {
        Thumbnail picture;
        picture.coverage = 0.5;
        return picture;
    });
    return candidates.at(0).group.framebuffer;
}

TEST(Rank, OfTwoFramebuffersTheLastIsTheScene) {
    EXPECT_EQ(best_framebuffer({group(1, ProjectionKind::perspective, 4000, 10),
                                group(2, ProjectionKind::perspective, 3000, 20)}),
              2u);
}

// dreamchess draws the board, then the board in colours that say what is where, then the rest of its window.
TEST(Rank, WhatLiesOverTheSceneCounts) {
    EXPECT_EQ(best_framebuffer({group(2, ProjectionKind::perspective, 79492, 10),
                                group(1, ProjectionKind::perspective, 39864, 20),
                                group(2, ProjectionKind::flat, 120, 30)}),
              2u);
}

TEST(Rank, AFramebufferWithoutASceneIsNone) {
    EXPECT_EQ(best_framebuffer({group(2, ProjectionKind::perspective, 4000, 10),
                                group(1, ProjectionKind::perspective, 12, 20),
                                group(3, ProjectionKind::flat, 2, 30)}),
              2u);
}

} // namespace
} // namespace glcast::preload
