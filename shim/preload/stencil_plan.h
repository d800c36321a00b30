// Which draws of a group are kept to places by the stencil test, and what is made of it in other views. The
// one place where that is said:
//
//  | the draw                                                   | is cast |
//  |------------------------------------------------------------|-----------------------------------------------|
//  | passes only where something marked the buffer: a cap,      | where it passes, worked out in each view |
//  |   a face filled by parity, a decal                         |   (capture/program_stencil.h) | | passes
//  where nothing did, is cut out by invisible marks:   | likewise                                      | | a
//  wall with a hole                                       |                                               |
//  | is cut out where it lies in front of what marked: an       | not at all: decoration around the program's
//  | |   outline, a halo                                          |   picture of what marked | | is cut out
//  by what is seen before it or in its place       | whole: it is hidden there, or the same        | | is lit
//  where counted shadow volumes are not                | whole                                         | | is
//  a mirror image (scene.h)                                | not at all                                    |
//  | passes by marks that cannot be made in another view        | whole, and counted |
#pragma once
#include "shim/preload/scene.h"

namespace glcast::preload {

/// What the program's own view has to tell of a draw: how it lies to what marked the buffer.
struct StencilQuestion {
    std::size_t draw = 0;
    std::vector<std::size_t> marks; ///< draws, rising
    /// May it be an outline, cut out by these marks? Else: may it be a decal, kept to them without a depth
    /// test?
    bool is_cut_out = true;
    bool shows_unmarked = true; ///< it shows wherever nothing marked
    bool marks_are_seen = true;
};

struct StencilPlan {
    long kept = 0;       ///< draws that are cast where their test passes
    long unfollowed = 0; ///< draws that are cast whole, for their marks cannot be made in another view
    long unanswered =
        0; ///< questions that nobody could answer: the draws are cast as if they were none of these
    std::vector<StencilQuestion> questions;
};

/// Notes in the draws of a group what they have to do with the stencil buffer.
StencilPlan plan_stencil(Scene& scene, int group);

/// Fragments of a draw over the pixels that were marked: all, and those clearly before and behind the marks.
struct Position {
    long all = 0, before = 0, behind = 0;
};

/// Takes the answer of a question into the plan.
void answer(Scene& scene, StencilPlan& plan, const StencilQuestion& question, const Position& position);

} // namespace glcast::preload
