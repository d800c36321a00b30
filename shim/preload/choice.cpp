#include "shim/preload/choice.h"

#include <algorithm>
#include <tuple>

namespace glcast::preload {

long substance(const Group& group, const Include& include) {
    return group.triangles + group.outlined + (include.lines ? group.lines : 0) +
           (include.points ? group.points : 0);
}

namespace {

constexpr double backdrop_coverage = 0.98;
constexpr double inset_share = 1.0 / 50; ///< of the pixels that the largest covers
constexpr double corner_inset_share = 1.0 / 4;
constexpr double corner_share = 1.0 / 16; ///< of the other's viewport: surely one
constexpr long inset_richness = 10;       ///< in a larger one, so many times the triangles of the other: none
constexpr long helper_richness =
    10; ///< an offscreen helper has at most so many times the triangles of the scene
constexpr std::size_t most_pictures = 16;

void add(Group& all, const Group& one) {
    all.draws += one.draws;
    all.last_draw = std::max(all.last_draw, one.last_draw);
    all.triangles += one.triangles;
    all.outlined += one.outlined;
    all.at_equal_depth += one.at_equal_depth;
    all.at_greater_depth += one.at_greater_depth;
    all.with_own_w += one.with_own_w;
    all.hidden_triangles += one.hidden_triangles;
    for (int hand = 0; hand < 2; ++hand) all.open_triangles[hand] += one.open_triangles[hand];
    all.judged_by_function += one.judged_by_function;
    all.guessed_view |= one.guessed_view;
    all.lines += one.lines;
    all.points += one.points;
    all.writes_depth |= one.writes_depth;
    if (!all.base_modelview || (all.base_is_stencilled && one.base_modelview && !one.base_is_stencilled)) {
        all.base_modelview = one.base_modelview;
        all.base_is_stencilled = one.base_is_stencilled;
    }
}

long area(const Group& group) { return long(group.viewport[2]) * group.viewport[3]; }

double pixels(const Candidate& c) { return c.picture.coverage * double(area(c.group)); }

void find_insets(std::vector<Candidate>& candidates, const Include& include) {
    for (Candidate& c : candidates) {
        if (!c.castable || c.backdrop || c.group.erased) continue;
        for (const Candidate& other : candidates) {
            if (&other == &c || !other.castable || other.backdrop || other.group.erased) continue;
            const bool richer =
                substance(c.group, include) > inset_richness * substance(other.group, include);
            const bool in_corner = corner_share * double(area(other.group)) > double(area(c.group));
            const bool smaller = pixels(c) < (in_corner ? corner_inset_share : inset_share) * pixels(other);
            c.inset |= smaller && (in_corner || !richer);
        }
    }
}

constexpr ChoiceRule rules[] = {
    {"may be cast", [](const Candidate& c, const Include&) -> long { return c.castable; }},
    {"is not painted over", [](const Candidate& c, const Include&) -> long { return !c.group.erased; }},
    {"is no backdrop", [](const Candidate& c, const Include&) -> long { return !c.backdrop; }},
    {"is no inset", [](const Candidate& c, const Include&) -> long { return !c.inset; }},
    // Of those that the rules so far leave equal, which are in front:
    {"does not only help to draw another",
     [](const Candidate& c, const Include&) -> long { return !c.helper; }},
    {"has half the triangles of the richest",
     [](const Candidate& c, const Include&) -> long { return c.rich; }},
    {"is drawn to the window itself",
     [](const Candidate& c, const Include&) -> long { return c.rich && c.group.framebuffer == 0; }},
    // Of the four views of a CAD program that one.
    {"is seen in perspective",
     [](const Candidate& c, const Include&) -> long {
         return c.rich && c.group.kind == ProjectionKind::perspective;
     }},
    {"has most triangles",
     [](const Candidate& c, const Include& include) { return substance(c.group, include); }},
    {"has most lines and points",
     [](const Candidate& c, const Include&) -> long { return c.group.lines + c.group.points; }},
    {"is largest on the screen", [](const Candidate& c, const Include&) { return area(c.group); }},
};
constexpr std::size_t front_rules = 4; ///< rules that say what is in front of all else

bool is_castable(const Candidate& c, const Include& include) {
    return c.group.is_spatial() && substance(c.group, include) > 0;
}

/// How far a group is in front, by the first rules alone: one number that orders as these do.
long front(const Candidate& c, const Include& include) {
    long all = 0;
    for (std::size_t i = 0; i < front_rules; ++i) all = 2 * all + rules[i].score(c, include);
    return all;
}

/// Of several framebuffers with a scene, none of them the window's, the one that was drawn to last, be it by
/// what lies over the scene. What went before helped to draw it (shadow and reflection maps, the numbers that
/// OpenCSG marks its bodies with, the colours by which dreamchess finds what the pointer is on).
template <class IsScene>
GLuint shown_framebuffer(const std::vector<Candidate>& candidates, const IsScene& may_be_shown) {
    GLuint shown = 0;
    long last = -1;
    for (const Candidate& c : candidates) {
        const auto shares = [&](const Candidate& o) {
            return o.group.framebuffer == c.group.framebuffer && may_be_shown(o);
        };
        if (c.group.last_draw <= last || std::none_of(candidates.begin(), candidates.end(), shares)) continue;
        last = c.group.last_draw;
        shown = c.group.framebuffer;
    }
    return shown;
}

void find_helpers(std::vector<Candidate>& candidates, const Include& include) {
    long best = 0, richest = 0;
    for (const Candidate& c : candidates) best = std::max(best, front(c, include));
    for (const Candidate& c : candidates)
        if (front(c, include) == best) richest = std::max(richest, substance(c.group, include));
    const GLuint shown = shown_framebuffer(candidates, [&](const Candidate& c) {
        return front(c, include) == best && helper_richness * substance(c.group, include) >= richest;
    });
    for (Candidate& c : candidates) {
        c.helper = shown != 0 && c.group.framebuffer != 0 && c.group.framebuffer != shown;
        c.rich = 2 * substance(c.group, include) >= richest;
    }
}

} // namespace

std::vector<Candidate> merge(const std::vector<Scene>& scenes,
                             const std::function<bool(int, int)>& may_join) {
    std::vector<Candidate> all;
    const int parts = static_cast<int>(scenes.size());
    const auto first_part = [](const Candidate& c) {
        return static_cast<int>(
            std::find_if(c.in_part.begin(), c.in_part.end(), [](int i) { return i >= 0; }) -
            c.in_part.begin());
    };
    for (int part = 0; part < parts; ++part) {
        for (std::size_t i = 0; i < scenes[part].groups.size(); ++i) {
            const Group& group = scenes[part].groups[i];
            const auto same = std::find_if(all.begin(), all.end(), [&](const Candidate& c) {
                return c.in_part[part] < 0 && c.group.same_place(group) && c.group.erased == group.erased &&
                       first_part(c) != part && may_join(first_part(c), part);
            });
            const bool is_new = same == all.end();
            Candidate& into = is_new ? all.emplace_back() : *same;
            if (is_new) {
                into.group = group;
                into.in_part.assign(parts, -1);
            } else {
                add(into.group, group);
            }
            into.in_part[part] = static_cast<int>(i);
        }
    }
    return all;
}

bool is_scene(const Candidate& candidate) { return candidate.castable && !candidate.backdrop; }

void draw_pictures(std::vector<Candidate>& candidates, const Include& include, bool pictures_of_all,
                   const std::function<Thumbnail(const Candidate&)>& draw_picture) {
    std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return std::tuple(is_castable(a, include), substance(a.group, include)) >
               std::tuple(is_castable(b, include), substance(b.group, include));
    });
    for (std::size_t i = 0; i < candidates.size() && i < most_pictures; ++i)
        if (pictures_of_all || is_castable(candidates[i], include))
            candidates[i].picture = draw_picture(candidates[i]);
}

void judge(std::vector<Candidate>& candidates, const Include& include) {
    for (Candidate& c : candidates) {
        c.castable = is_castable(c, include);
        c.backdrop = c.castable && c.group.kind != ProjectionKind::perspective && c.picture.flat &&
                     c.picture.coverage >= backdrop_coverage;
    }
    find_insets(candidates, include);
    find_helpers(candidates, include);
}

std::span<const ChoiceRule> choice_rules() { return rules; }

const ChoiceRule* deciding_rule(const Candidate& a, const Candidate& b, const Include& include) {
    const auto differs = [&](const ChoiceRule& rule) {
        return rule.score(a, include) != rule.score(b, include);
    };
    const auto* const rule = std::find_if(std::begin(rules), std::end(rules), differs);
    return rule == std::end(rules) ? nullptr : rule;
}

void rank(std::vector<Candidate>& candidates, const Include& include) {
    judge(candidates, include);
    std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        const ChoiceRule* const rule = deciding_rule(a, b, include);
        return rule && rule->score(a, include) > rule->score(b, include);
    });
}

} // namespace glcast::preload
