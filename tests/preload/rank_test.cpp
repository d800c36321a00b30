// Which group of draws is the scene: each rule of the table decides between two groups that are alike in all
// that the rules before it ask.
#include <gtest/gtest.h>

#include <set>

#include "shim/preload/choice.h"

namespace glcast::preload {
namespace {

/// 4000 triangles in perspective, half of a window of 640 x 480.
Candidate scene() {
    Candidate candidate;
    candidate.group.kind = ProjectionKind::perspective;
    candidate.group.triangles = 4000;
    candidate.group.viewport = {0, 0, 640, 480};
    candidate.picture.coverage = 0.5;
    return candidate;
}

Candidate with(void (*change)(Candidate&)) {
    Candidate candidate = scene();
    change(candidate);
    return candidate;
}

struct Case {
    const char* rule;
    Candidate better, other;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"may be cast", scene(), with([](Candidate& c) { c.group.triangles = 0, c.group.lines = 9000; })},
        {"may be cast", scene(), with([](Candidate& c) { c.group.kind = ProjectionKind::flat; })},
        {"is not painted over", scene(), with([](Candidate& c) { c.group.erased = true; })},
        {"is no backdrop",
         with([](Candidate& c) { c.group.kind = ProjectionKind::orthographic, c.group.writes_depth = true; }),
         with([](Candidate& c) {
             c.group.kind = ProjectionKind::orthographic, c.group.writes_depth = true;
             c.group.triangles = 9000, c.picture.flat = true, c.picture.coverage = 1;
         })},
        // Axes in a corner, however many triangles they have.
        {"is no inset", scene(), with([](Candidate& c) {
             c.group.viewport = {0, 0, 100, 100}, c.group.triangles = 90000;
         })},
        // A map of shadows with the same triangles, drawn before what is shown.
        {"does not only help to draw another",
         with([](Candidate& c) { c.group.framebuffer = 2, c.group.last_draw = 20; }), with([](Candidate& c) {
             c.group.framebuffer = 1, c.group.last_draw = 10, c.group.triangles = 9000;
         })},
        {"has half the triangles of the richest",
         with([](Candidate& c) { c.group.framebuffer = 1, c.group.last_draw = 10; }),
         with([](Candidate& c) { c.group.triangles = 1000; })},
        {"is drawn to the window itself", scene(), with([](Candidate& c) {
             c.group.framebuffer = 1, c.group.last_draw = 10, c.group.triangles = 5000;
         })},
        {"is seen in perspective", scene(), with([](Candidate& c) {
             c.group.kind = ProjectionKind::orthographic, c.group.writes_depth = true;
             c.group.triangles = 5000;
         })},
        {"has most triangles", scene(), with([](Candidate& c) { c.group.triangles = 3999; })},
        {"has most lines and points", with([](Candidate& c) { c.group.lines = 1; }), scene()},
        {"is largest on the screen", scene(), with([](Candidate& c) {
             c.group.viewport = {0, 0, 640, 479};
         })},
    };
    return all;
}

TEST(choice, each_rule_decides_what_it_is_for) {
    for (const Case& one : cases()) {
        SCOPED_TRACE(one.rule);
        for (const bool better_first : {true, false}) {
            std::vector<Candidate> both{one.better, one.other};
            if (!better_first) std::swap(both[0], both[1]);
            rank(both, Include{});
            const ChoiceRule* const rule = deciding_rule(both[0], both[1], Include{});
            ASSERT_NE(rule, nullptr);
            EXPECT_STREQ(rule->name, one.rule);
            const auto same = [&](const Candidate& a, const Candidate& b) {
                return a.group.triangles == b.group.triangles && a.group.lines == b.group.lines &&
                       a.group.framebuffer == b.group.framebuffer && a.group.kind == b.group.kind &&
                       a.group.erased == b.group.erased && a.group.viewport == b.group.viewport;
            };
            EXPECT_TRUE(same(both[0], one.better));
        }
    }
}

TEST(choice, every_rule_has_a_case) {
    std::set<std::string> tested;
    for (const Case& one : cases()) tested.insert(one.rule);
    for (const ChoiceRule& rule : choice_rules()) EXPECT_EQ(tested.count(rule.name), 1u) << rule.name;
    EXPECT_EQ(tested.size(), choice_rules().size());
}

TEST(choice, groups_that_no_rule_tells_apart_keep_their_order) {
    std::vector<Candidate> both{with([](Candidate& c) { c.number = 1; }),
                                with([](Candidate& c) { c.number = 2; })};
    rank(both, Include{});
    EXPECT_EQ(deciding_rule(both[0], both[1], Include{}), nullptr);
    EXPECT_EQ(both[0].number, 1);
}

// Pictures cost a replay each.
TEST(choice, pictures_are_drawn_of_what_may_be_cast_richest_first) {
    std::vector<Candidate> all{with([](Candidate& c) { c.group.triangles = 10; }),
                               with([](Candidate& c) { c.group.kind = ProjectionKind::flat; }),
                               with([](Candidate& c) { c.group.triangles = 20; })};
    std::vector<long> drawn;
    draw_pictures(all, Include{}, false, [&](const Candidate& c) {
        drawn.push_back(c.group.triangles);
        return Thumbnail{};
    });
    EXPECT_EQ(drawn, (std::vector<long>{20, 10}));
}

Candidate in_framebuffer(GLuint framebuffer, ProjectionKind kind, long triangles, long last_draw) {
    Candidate candidate = scene();
    candidate.group.framebuffer = framebuffer;
    candidate.group.kind = kind;
    candidate.group.triangles = triangles;
    candidate.group.last_draw = last_draw;
    return candidate;
}

GLuint best_framebuffer(std::vector<Candidate> candidates) {
    rank(candidates, Include{});
    return candidates.at(0).group.framebuffer;
}

// dreamchess draws the board, then the board in colours that say what is where, then the rest of its window.
TEST(choice, what_lies_over_the_scene_tells_which_framebuffer_is_shown) {
    EXPECT_EQ(best_framebuffer({in_framebuffer(2, ProjectionKind::perspective, 79492, 10),
                                in_framebuffer(1, ProjectionKind::perspective, 39864, 20),
                                in_framebuffer(2, ProjectionKind::flat, 120, 30)}),
              2u);
}

TEST(choice, a_framebuffer_without_a_scene_is_not_shown) {
    EXPECT_EQ(best_framebuffer({in_framebuffer(2, ProjectionKind::perspective, 4000, 10),
                                in_framebuffer(1, ProjectionKind::perspective, 12, 20),
                                in_framebuffer(3, ProjectionKind::flat, 2, 30)}),
              2u);
}

} // namespace
} // namespace glcast::preload
