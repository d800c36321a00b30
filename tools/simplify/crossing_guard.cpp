#include "tools/simplify/crossing_guard.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/mesh/triangle_contact.h"

namespace glcast {
namespace {

// Of the coordinates: what rounding to floats may do to the distance of two points, doubled, and what
// rounding of doubles does.
constexpr double float_step = 2.5e-7, double_step = 1e-14;
// Cosine to the common direction; far above what either rounding does to a triangle that is no needle.
constexpr double least_cosine = 0.1;
// A tree is made anew when so few of its triangles are left.
constexpr double worn_out = 0.4;
constexpr std::size_t never_worn_out = 256;

Triangle corners_of(const CrossingGuard::Surface& surface, std::uint32_t t) {
    return {surface.corners[3 * t], surface.corners[3 * t + 1], surface.corners[3 * t + 2]};
}

Facet facet_of(const CrossingGuard::Surface& surface, const Triangle& t) {
    return {t, {surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]}};
}

glm::dvec3 doubled_area(const std::array<glm::dvec3, 3>& at) { return cross(at[1] - at[0], at[2] - at[0]); }

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

/// What was taken away crossed it already?
bool crossed(const CrossingGuard::Surface& surface, const SurfaceChange& change, const Triangle& other) {
    return std::any_of(change.replaced.begin(), change.replaced.end(), [&](std::uint32_t t) {
        return triangles_meet(surface.positions, corners_of(surface, t), other);
    });
}

bool crossed_each_other(const CrossingGuard::Surface& surface, const SurfaceChange& change) {
    for (std::size_t i = 1; i < change.replaced.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (triangles_meet(surface.positions, corners_of(surface, change.replaced[i]),
                               corners_of(surface, change.replaced[j])))
                return true;
    return false;
}

} // namespace

CrossingGuard::CrossingGuard(const Surface& surface, bool closed)
    : is_closed(closed), triangle_mark(surface.corners.size() / 3, 0),
      vertex_mark(surface.positions.size(), 0) {
    if (surface.positions.empty()) return;
    glm::dvec3 low = surface.positions[0], high = low;
    for (const glm::dvec3& p : surface.positions) low = min(low, p), high = max(high, p);
    middle = (low + high) * 0.5;
    const glm::dvec3 largest = max(abs(low), abs(high));
    const double coordinate = std::max({largest.x, largest.y, largest.z});
    nearness = {coordinate * float_step, coordinate * double_step};
    build(surface);
}

bool CrossingGuard::lives(const Surface& surface, std::uint32_t t) const {
    const Triangle corners = corners_of(surface, t);
    return std::max({corners[0], corners[1], corners[2]}) < surface.positions.size();
}

std::vector<BoxTree::Item> CrossingGuard::all_items(const Surface& surface) const {
    std::vector<BoxTree::Item> items;
    for (std::uint32_t t = 0; t < triangle_mark.size(); ++t)
        if (lives(surface, t)) items.push_back(item_of(surface, t));
    return items;
}

void CrossingGuard::build(const Surface& surface) {
    const std::vector<BoxTree::Item> items = all_items(surface);
    live = built = items.size();
    grid = FacingGrid(items);
    has_tree = false;
}

void CrossingGuard::build_tree(const Surface& surface) {
    tree = BoxTree(all_items(surface), triangle_mark.size());
    has_tree = true;
    changed.clear();
    late.clear();
    first_late.assign(grid.count(), UINT32_MAX);
}

/// Wider all round by what is too near.
FloatBox CrossingGuard::box_of(const std::array<glm::dvec3, 3>& at) const {
    const glm::dvec3 room(nearness.distance);
    return {glm::vec3(min(min(at[0], at[1]), at[2]) - middle - room),
            glm::vec3(max(max(at[0], at[1]), at[2]) - middle + room)};
}

BoxTree::Item CrossingGuard::item_of(const Surface& surface, std::uint32_t t) const {
    const Facet facet = facet_of(surface, corners_of(surface, t));
    return {box_of(facet.at), glm::vec3(unit(doubled_area(facet.at))), t};
}

void CrossingGuard::made_it(const Surface& surface, const SurfaceChange& change) {
    live -= change.replaced.size() - made.size();
    if (built > never_worn_out && double(live) < worn_out * double(built)) return build(surface);
    grid.add(made_box, faced);
    if (!has_tree) return;
    const auto first = std::uint32_t(changed.size()), count = std::uint32_t(change.replaced.size());
    changed.insert(changed.end(), change.replaced.begin(), change.replaced.end());
    grid.each(made_box, [&](std::size_t cell) {
        late.push_back({first, count, first_late[cell]});
        first_late[cell] = std::uint32_t(late.size() - 1);
    });
}

/// The tree, as far as the box reaches; what is gone stays in it.
void CrossingGuard::bring_up_to_date(const Surface& surface, const FloatBox& box) {
    if (!has_tree) return build_tree(surface);
    grid.each(box, [&](std::size_t cell) {
        for (std::uint32_t k = first_late[cell]; k != UINT32_MAX; k = late[k].next)
            for (const std::uint32_t t : std::span(changed).subspan(late[k].first, late[k].count))
                if (lives(surface, t)) tree.change(item_of(surface, t));
        first_late[cell] = UINT32_MAX;
    });
}

std::optional<glm::dvec3> CrossingGuard::take_made(const Surface& surface, const SurfaceChange& change) {
    made.clear();
    made_box = {};
    faced = ~Facing(0);
    glm::dvec3 sum(0);
    for (const Triangle& t : change.made) {
        Facet facet = facet_of(surface, t);
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] == change.moved) facet.at[k] = change.to;
        const glm::dvec3 area = doubled_area(facet.at);
        sum += area;
        made.push_back({facet, box_of(facet.at), unit(area)});
        made_box.add(made.back().box);
        faced &= facing(glm::vec3(made.back().normal));
    }
    const glm::dvec3 direction = unit(sum);
    for (const Made& triangle : made)
        if (dot(triangle.normal, direction) < least_cosine) return {};
    return direction;
}

void CrossingGuard::mark(const Surface& surface, const SurfaceChange& change) {
    ++marks;
    for (const std::uint32_t t : change.replaced) {
        triangle_mark[t] = marks;
        for (const std::uint32_t v : corners_of(surface, t))
            if (v < vertex_mark.size()) vertex_mark[v] = marks;
    }
}

/// Is it all on one side of the triangle's plane, but for corners that they share?
bool CrossingGuard::beyond(const Made& triangle, const Facet& other) const {
    const Triangle& own = triangle.facet.corners;
    bool above = true, below = true;
    for (std::size_t k = 0; k < 3; ++k) {
        if (other.corners[k] == own[0] || other.corners[k] == own[1] || other.corners[k] == own[2]) continue;
        const double height = dot(triangle.normal, other.at[k] - triangle.facet.at[0]);
        above &= height > nearness.distance;
        below &= height < -nearness.distance;
    }
    return above != below;
}

bool CrossingGuard::meets(const Surface& surface, const SurfaceChange& change,
                          const BoxTree::Item& other) const {
    const Facet facet = facet_of(surface, corners_of(surface, other.triangle));
    for (const Made& triangle : made)
        if (triangle.box.overlaps(other.box) && !beyond(triangle, facet) &&
            !are_apart(triangle.facet, facet, nearness))
            return !crossed(surface, change, facet.corners);
    return false;
}

bool CrossingGuard::meet_each_other(const Surface& surface, const SurfaceChange& change) const {
    for (std::size_t i = 1; i < made.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!are_apart(made[i].facet, made[j].facet, nearness))
                return !crossed_each_other(surface, change);
    return false;
}

/// What the change takes up along a direction.
CrossingGuard::Slab CrossingGuard::slab_of(const Surface& surface, const SurfaceChange& change,
                                           const glm::dvec3& direction) const {
    Slab slab;
    for (const Made& triangle : made)
        for (const glm::dvec3& p : triangle.facet.at) slab.add(dot(direction, p - middle));
    for (const std::uint32_t t : change.replaced)
        for (const std::uint32_t v : corners_of(surface, t))
            if (v < surface.positions.size()) slab.add(dot(direction, surface.positions[v] - middle));
    return slab;
}

bool CrossingGuard::crosses(const Surface& surface, const SurfaceChange& change) {
    const std::optional<glm::dvec3> direction = take_made(surface, change);
    FloatBox box = made_box;
    for (const std::uint32_t t : change.replaced)
        if (lives(surface, t)) box.add(box_of(facet_of(surface, corners_of(surface, t)).at));
    if (is_closed && faced && grid.common(box, faced)) return false;
    bring_up_to_date(surface, box);
    mark(surface, change);
    others.clear();
    bool one_way = is_closed && direction;
    const glm::vec3 towards(direction.value_or(glm::dvec3(0)));
    const Slab slab = one_way ? slab_of(surface, change, *direction) : Slab{};
    tree.overlapping(box, [&](const BoxTree::Item& item) {
        if (!lives(surface, item.triangle)) return;
        if (one_way && dot(item.normal, towards) <= float(least_cosine)) {
            Slab of_item;
            for (const std::uint32_t v : corners_of(surface, item.triangle))
                of_item.add(dot(*direction, surface.positions[v] - middle));
            if (of_item.clear_of(slab, nearness.distance)) return;
            one_way = false;
        }
        if (triangle_mark[item.triangle] != marks) others.push_back(&item);
    });
    if (!one_way && meet_each_other(surface, change)) return true;
    return std::any_of(others.begin(), others.end(), [&](const BoxTree::Item* other) {
        if (one_way)
            for (const std::uint32_t v : corners_of(surface, other->triangle))
                if (vertex_mark[v] == marks) return false; // joined to what is made
        return meets(surface, change, *other);
    });
}

} // namespace glcast
