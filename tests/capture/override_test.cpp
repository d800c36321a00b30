#include <gtest/gtest.h>

#include "capture/gl/call_classes.h"
#include "capture/gl/override_table.h"

namespace glcast {
namespace {

using G = GlTable;

/// The calls that reached the driver, with their first argument.
std::vector<std::pair<const char*, GLenum>> made;

void APIENTRY real_enable(GLenum cap) { made.emplace_back("Enable", cap); }
void APIENTRY real_disable(GLenum cap) { made.emplace_back("Disable", cap); }
void APIENTRY real_matrix_mode(GLenum mode) { made.emplace_back("MatrixMode", mode); }
void APIENTRY real_clear(GLbitfield buffers) { made.emplace_back("Clear", buffers); }
GLboolean APIENTRY real_is_enabled(GLenum) { return GL_TRUE; }
void APIENTRY real_draw_arrays(GLenum mode, GLint, GLsizei) { made.emplace_back("DrawArrays", mode); }

GlTable driver() {
    made.clear();
    GlTable table{};
    table.Enable = real_enable;
    table.Disable = real_disable;
    table.MatrixMode = real_matrix_mode;
    table.Clear = real_clear;
    table.IsEnabled = real_is_enabled;
    table.DrawArrays = real_draw_arrays;
    return table;
}

struct Owner {
    const GlTable& real;
    GLenum kept;
    const GlTable& below() const { return real; }
    bool owns(GLenum cap) const { return cap == kept; }
};

struct Twice {
    using Owner = glcast::Owner;
    static constexpr const char* what = "made twice";
    static void call(auto below, auto... arguments) { below(arguments...), below(arguments...); }
};

GlTable overridden(const GlTable& real, std::span<const OverrideRule> rules, unsigned when = always) {
    GlTable table = real;
    override_calls(table, real, rules, when);
    return table;
}

TEST(Override, CallsInNoRuleAreThoseBelow) {
    const GlTable real = driver();
    const OverrideRule rules[] = {{always, drop(only<&G::Clear>), ""}};
    EXPECT_EQ(overridden(real, rules).Enable, real_enable);
}

TEST(Override, DroppedCallsDoNothingAndReturnNothing) {
    const GlTable real = driver();
    const OverrideRule rules[] = {{always, drop(only<&G::Clear, &G::IsEnabled>), ""}};
    const GlTable table = overridden(real, rules);
    table.Clear(1);
    EXPECT_EQ(table.IsEnabled(GL_BLEND), GL_FALSE);
    EXPECT_TRUE(made.empty());
}

TEST(Override, WhatTheDriverLacksStaysMissing) {
    const GlTable real = driver();
    const OverrideRule rules[] = {{always, drop(only<&G::Accum>), ""},
                                  {always, replace<real_clear>(only<&G::PushAttrib>), ""},
                                  {always, handle<Twice>(calls::array_draws), ""}};
    const GlTable table = overridden(real, rules);
    EXPECT_EQ(table.Accum, nullptr);
    EXPECT_EQ(table.PushAttrib, nullptr);
    EXPECT_EQ(table.DrawElements, nullptr);
    EXPECT_NE(table.DrawArrays, nullptr);
}

TEST(Override, AHandlerOfAClassCallsWhatIsBelow) {
    const GlTable real = driver();
    Owner owner{real, 0};
    table_owner<Owner> = &owner;
    const OverrideRule rules[] = {{always, handle<Twice>(calls::array_draws + only<&G::MatrixMode>), ""}};
    const GlTable table = overridden(real, rules);
    table.DrawArrays(GL_QUADS, 0, 4);
    table.MatrixMode(GL_TEXTURE);
    const decltype(made) expected{{"DrawArrays", GL_QUADS},
                                  {"DrawArrays", GL_QUADS},
                                  {"MatrixMode", GL_TEXTURE},
                                  {"MatrixMode", GL_TEXTURE}};
    EXPECT_EQ(made, expected);
}

TEST(Override, TheLastRuleThatHoldsCounts) {
    const GlTable real = driver();
    const OverrideRule rules[] = {{1, drop(only<&G::Clear>), ""}, {2, keep(only<&G::Clear>), ""}};
    EXPECT_NE(overridden(real, rules, 1).Clear, real_clear);
    EXPECT_EQ(overridden(real, rules, 1 | 2).Clear, real_clear);
    EXPECT_EQ(overridden(real, rules, 4).Clear, real_clear);
}

TEST(Override, OwnedCapsStay) {
    const GlTable real = driver();
    Owner owner{real, GL_BLEND};
    table_owner<Owner> = &owner;
    const OverrideRule rules[] = {{always, handle<SwitchNotOwned<Owner>>(only<&G::Enable, &G::Disable>), ""}};
    const GlTable table = overridden(real, rules);
    table.Enable(GL_BLEND), table.Disable(GL_BLEND), table.Enable(GL_FOG), table.Disable(GL_FOG);
    const decltype(made) expected{{"Enable", GL_FOG}, {"Disable", GL_FOG}};
    EXPECT_EQ(made, expected);
}

// The registry's names of parameters say which argument is the count.
TEST(CallClasses, KnowTheArgumentsOfDraws) {
    const auto same = [](DrawArguments a, DrawArguments b) {
        return a.count == b.count && a.instances == b.instances && a.number == b.number;
    };
    EXPECT_TRUE(same(draw_arguments<&G::DrawArrays>, {2, -1, -1}));
    EXPECT_TRUE(same(draw_arguments<&G::DrawRangeElements>, {3, -1, -1}));
    EXPECT_TRUE(same(draw_arguments<&G::DrawArraysInstancedARB>, {2, 3, -1}));
    EXPECT_TRUE(same(draw_arguments<&G::DrawElementsInstancedBaseVertexBaseInstance>, {1, 4, -1}));
    EXPECT_TRUE(same(draw_arguments<&G::MultiDrawArraysEXT>, {2, -1, 3}));
    EXPECT_TRUE(same(draw_arguments<&G::MultiDrawElementsBaseVertex>, {1, -1, 4}));
    EXPECT_TRUE(same(draw_arguments<&G::MultiDrawArraysIndirect>, {-1, -1, -1}));
    EXPECT_TRUE(same(draw_arguments<&G::DrawTransformFeedbackStreamInstanced>, {-1, 3, -1}));
}

} // namespace
} // namespace glcast
