#include "shim/preload/stencil_plan.h"

#include <algorithm>
#include <utility>

namespace glcast::preload {
namespace {

constexpr int all_bits = 0xff;

bool overlap(const std::array<GLint, 4>& a, const std::array<GLint, 4>& b) {
    return a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3];
}

bool contains(const std::array<GLint, 4>& outer, const std::array<GLint, 4>& inner) {
    return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[0] + outer[2] >= inner[0] + inner[2] &&
           outer[1] + outer[3] >= inner[1] + inner[3];
}

bool counts(GLenum operation) {
    return operation == GL_INCR || operation == GL_DECR || operation == GL_INCR_WRAP ||
           operation == GL_DECR_WRAP;
}

/// Goes through the events of one group's place.
class Planner {
  public:
    Planner(Scene& of, int index) : scene(of), number(index), group(of.groups[index]) {}

    StencilPlan run() {
        for (const StencilEvent& event : scene.stencil_events) {
            if (const auto* clear = std::get_if<StencilClear>(&event))
                see(*clear);
            else
                see(std::get<StencilDraw>(event));
        }
        return plan;
    }

  private:
    void see(const StencilClear& clear) {
        if (clear.framebuffer != group.framebuffer) return;
        if (clear.is_scissored && !overlap(clear.scissor, group.viewport)) return;
        is_partial = clear.is_scissored && !contains(clear.scissor, group.viewport);
        if (is_partial) return;
        const int writes = static_cast<int>(clear.writes);
        value = (value & ~writes) | (clear.value & writes);
        cleared_to = value;
        is_known = true;
        marks.clear();
    }

    void see(const StencilDraw& one) {
        Draw& draw = scene.draws[one.draw];
        const Group& its = scene.groups[draw.group];
        if (its.framebuffer != group.framebuffer || !overlap(its.viewport, group.viewport)) return;
        const bool is_ours = draw.group == number;
        const bool may_mark = one.front.marks() || one.back.marks();
        const bool tests = one.front.tests() || one.back.tests();
        if (is_ours && tests && draw.kind == Draw::Kind::filled) decide(one, draw);
        if (may_mark) marks.push_back(&one);
        if (!is_ours || !(may_mark || draw.stencil.is_kept)) return;
        draw.stencil.marks = may_mark;
        draw.stencil.cleared_to = std::exchange(cleared_to, std::nullopt);
    }

    void decide(const StencilDraw& one, Draw& draw) {
        if (is_reflection(draw, group)) return;
        const bool passes_unmarked = one.front.passes(value);
        if (marks.empty() && is_known && !is_partial) {
            draw.stencil.is_kept = !passes_unmarked;
            plan.kept += draw.stencil.is_kept;
            return;
        }
        if (are_shadow_volumes() || (marks.empty() && passes_unmarked && !is_partial)) return;
        if (!can_be_followed(one)) {
            ++plan.unfollowed;
            return;
        }
        draw.stencil.is_kept = true;
        ++plan.kept;
        ask(one, draw, passes_unmarked);
    }

    void ask(const StencilDraw& one, const Draw& draw, bool passes_unmarked) {
        const auto cuts = [&](const StencilDraw& mark) {
            return !passes_marked(one, mark).value_or(!passes_unmarked);
        };
        StencilQuestion question{one.draw, {}, true, passes_unmarked, true};
        question.is_cut_out = draw.tests_depth || draw.writes_depth;
        if (!question.is_cut_out && passes_unmarked) return; // drawn over what is there: never solid
        for (const StencilDraw* mark : marks) {
            const bool has_same_test = mark->front.function == one.front.function &&
                                       mark->front.reference == one.front.reference && one.front.tests();
            const bool is_surface = mark->shows && scene.draws[mark->draw].writes_depth;
            if (has_same_test || cuts(*mark) != question.is_cut_out) continue;
            if (!question.is_cut_out && !is_surface) continue;
            question.marks.push_back(mark->draw);
            question.marks_are_seen &= mark->shows;
        }
        if (!question.marks.empty()) plan.questions.push_back(std::move(question));
    }

    /// Where the mark is; nothing where what it leaves depends on what was there.
    static std::optional<bool> passes_marked(const StencilDraw& one, const StencilDraw& mark) {
        switch (mark.front.shown) {
        case GL_REPLACE:
            return one.front.passes(mark.front.reference & all_bits);
        case GL_ZERO:
            return one.front.passes(0);
        default:
            return std::nullopt;
        }
    }

    bool can_be_followed(const StencilDraw& one) const {
        const bool same_for_both = one.front.function == one.back.function &&
                                   one.front.bits == one.back.bits &&
                                   one.front.reference == one.back.reference;
        if (!same_for_both || marks.empty() || is_partial) return false;
        return std::all_of(marks.begin(), marks.end(), [&](const StencilDraw* mark) {
            return scene.draws[mark->draw].group == number && !goes_by_hidden(*mark);
        });
    }

    /// Only what lies behind something else marks.
    static bool goes_by_hidden(const StencilDraw& mark) {
        if (!mark.tests_depth) return false;
        const auto same = [](const StencilFace& face) { return face.hidden == face.shown; };
        if (same(mark.front) && same(mark.back)) return false;
        const auto only_hidden = [](const StencilFace& face) {
            return face.shown == GL_KEEP && face.hidden != GL_KEEP;
        };
        const GLenum function = mark.depth_function;
        return function == GL_GREATER || function == GL_GEQUAL || function == GL_NEVER ||
               function == GL_NOTEQUAL || only_hidden(mark.front) || only_hidden(mark.back);
    }

    /// What they count is how many of their faces lie before, or behind, what is drawn already.
    bool are_shadow_volumes() const {
        return std::any_of(marks.begin(), marks.end(), [&](const StencilDraw* mark) {
            const Draw& draw = scene.draws[mark->draw];
            const auto by_depth = [](const StencilFace& face) {
                return face.hidden != face.shown && (counts(face.hidden) || counts(face.shown));
            };
            return mark->tests_depth && !mark->shows && !draw.writes_depth && !draw.before_depth &&
                   !mark->is_clipped && (by_depth(mark->front) || by_depth(mark->back));
        });
    }

    Scene& scene;
    const int number;
    const Group& group;
    StencilPlan plan;
    int value = 0;         ///< where nothing marked
    bool is_known = false; ///< the frame itself cleared it
    bool is_partial = false;
    std::optional<int> cleared_to;
    std::vector<const StencilDraw*> marks; ///< since it was cleared
};

constexpr int part = 8; ///< less than so small a part of the fragments is rounding

} // namespace

StencilPlan plan_stencil(Scene& scene, int group) {
    const bool has_buffer = scene.groups[group].framebuffer != 0 || scene.window_has_stencil;
    if (scene.stencil_events.empty() || !has_buffer) return {};
    return Planner(scene, group).run();
}

void answer(Scene& scene, StencilPlan& plan, const StencilQuestion& question, const Position& position) {
    Draw& draw = scene.draws[question.draw];
    if (!question.is_cut_out) {
        draw.is_decal = position.all > 0 && part * (position.before + position.behind) <= position.all;
        return;
    }
    draw.is_outline = part * position.before > position.all;
    const bool is_whole = question.shows_unmarked && question.marks_are_seen;
    if (!draw.is_outline && !is_whole) return;
    draw.stencil.is_kept = false;
    --plan.kept;
}

} // namespace glcast::preload
