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

/// Of several framebuffers with a scene, none of them the window's, the one that was drawn to last, be it by
/// what lies over the scene. What went before helped to draw it (shadow and reflection maps, the numbers that
/// OpenCSG marks its bodies with, the colours by which dreamchess finds what the pointer is on).
template <class IsScene>
GLuint shown_framebuffer(const std::vector<Candidate>& candidates, const IsScene& is_scene) {
    GLuint shown = 0;
    long last = -1;
    for (const Candidate& c : candidates) {
        const auto shares = [&](const Candidate& o) {
            return o.group.framebuffer == c.group.framebuffer && is_scene(o);
        };
        if (c.group.last_draw <= last || std::none_of(candidates.begin(), candidates.end(), shares)) continue;
        last = c.group.last_draw;
        shown = c.group.framebuffer;
    }
    return shown;
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

void rank(std::vector<Candidate>& candidates, const Include& include, bool pictures_of_all,
          const std::function<Thumbnail(const Candidate&)>& draw_picture) {
    for (Candidate& c : candidates) {
        const long solid = substance(c.group, include);
        c.castable = c.group.is_spatial() && solid > 0;
    }
    std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return std::tuple(a.castable, substance(a.group, include)) >
               std::tuple(b.castable, substance(b.group, include));
    });
    for (std::size_t i = 0; i < candidates.size() && i < most_pictures; ++i) {
        Candidate& c = candidates[i];
        if (!pictures_of_all && !c.castable) continue;
        c.picture = draw_picture(c);
        c.backdrop = c.castable && c.group.kind != ProjectionKind::perspective && c.picture.flat &&
                     c.picture.coverage >= backdrop_coverage;
    }
    find_insets(candidates, include);
    const auto in_front = [](const Candidate& c) {
        return std::tuple(c.castable, !c.group.erased, !c.backdrop, !c.inset);
    };
    const auto best =
        std::max_element(candidates.begin(), candidates.end(),
                         [&](const auto& a, const auto& b) { return in_front(a) < in_front(b); });
    long richest = 0;
    for (const Candidate& c : candidates)
        if (in_front(c) == in_front(*best)) richest = std::max(richest, substance(c.group, include));
    const GLuint shown = shown_framebuffer(candidates, [&](const Candidate& c) {
        return in_front(c) == in_front(*best) && helper_richness * substance(c.group, include) >= richest;
    });
    const auto key = [&](const Candidate& c) {
        const long solid = substance(c.group, include);
        const bool helps = shown != 0 && c.group.framebuffer != 0 && c.group.framebuffer != shown;
        const bool rich = 2 * solid >= richest;
        return std::tuple(in_front(c), !helps, rich, rich && c.group.framebuffer == 0,
                          rich && c.group.kind == ProjectionKind::perspective, solid,
                          c.group.lines + c.group.points, area(c.group));
    };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate& a, const Candidate& b) { return key(a) > key(b); });
}

} // namespace glcast::preload
