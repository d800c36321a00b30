#include "tools/simplify/patch.h"

#include <glm/geometric.hpp>
#include <stdexcept>

namespace glcast {
namespace {

/// Squared; 1 is equilateral.
double squared_quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double squared_normal) {
    const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
    return squares > 0 ? 12 * squared_normal / (squares * squares) : 0;
}

// Tried where the best one would let the surface cross itself.
constexpr std::size_t most_places = 16;

// Of the length of the sum of normals to the sum of their lengths: below, the surface turns back on itself.
constexpr double flat_enough = 0.4;

} // namespace

template <int N> void Patch<N>::connect(std::vector<std::uint32_t> corners) {
    at = std::move(corners);
    find_twins();
    number_edges();
    quadrics.resize(position.size());
    mark.assign(position.size(), 0);
    near_refused.assign(position.size(), 0);
}

template <int N> void Patch<N>::keep_from_crossing() {
    if (!guard) guard.emplace(guarded(), ghost == none || out[ghost] == none);
}

template <int N> void Patch<N>::find_twins() {
    std::vector<std::uint32_t> first(position.size() + 1, 0), leaving(at.size());
    for (const std::uint32_t v : at) ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    out.assign(position.size(), none);
    std::vector<std::uint32_t> end(first.begin(), first.end() - 1);
    for (std::uint32_t c = 0; c < at.size(); ++c) {
        leaving[end[at[c]]++] = c;
        out[at[c]] = c;
    }
    twin.assign(at.size(), none);
    for (std::uint32_t c = 0; c < at.size(); ++c) {
        const std::uint32_t from = at[c], to = after(c);
        if (twin[c] != none || from == ghost || to == ghost) continue;
        for (std::uint32_t i = first[to]; i < first[to + 1]; ++i)
            if (const std::uint32_t back = leaving[i]; after(back) == from) {
                twin[c] = back;
                twin[back] = c;
                break;
            }
    }
    if (ghost == none) return;
    // Each vertex of a boundary has one half-edge to the ghost and one from it.
    std::vector<std::uint32_t> to_ghost(position.size(), none);
    for (std::uint32_t c = 0; c < at.size(); ++c)
        if (after(c) == ghost) to_ghost[at[c]] = c;
    for (std::uint32_t i = first[ghost]; i < first[ghost + 1]; ++i)
        if (const std::uint32_t back = leaving[i], there = to_ghost[after(back)]; there != none) {
            twin[back] = there;
            twin[there] = back;
        }
}

template <int N> void Patch<N>::number_edges() {
    edge.assign(at.size(), none);
    half.clear();
    for (std::uint32_t c = 0; c < at.size(); ++c) {
        if (edge[c] != none || locked[at[c]] || locked[after(c)]) continue;
        if (twin[c] == none)
            throw std::logic_error("simplify: a free edge at the rim of its patch: a bug in glcast");
        edge[c] = edge[twin[c]] = std::uint32_t(half.size());
        half.push_back(c);
    }
    refused.assign(half.size(), 0);
}

template <int N> Placement Patch<N>::place_edge(std::uint32_t c) const {
    const std::uint32_t a = at[c], b = after(c);
    Quadric<N> q = quadrics[a];
    q += quadrics[b];
    return place(q.reduced(), position[a], position[b]);
}

template <int N> std::vector<float> Patch<N>::costs() const {
    std::vector<float> all(half.size());
    for (std::size_t e = 0; e < half.size(); ++e) all[e] = float(place_edge(half[e]).cost);
    return all;
}

template <int N> void Patch<N>::queue_edges(float dearest) {
    most = dearest;
    queue.start(half.size(), in_exact_order);
    for (std::uint32_t e = 0; e < half.size(); ++e)
        if (const float cost = float(place_edge(half[e]).cost); cost <= most) queue.add(cost, e);
    queue.put_in_order();
}

template <int N> void Patch<N>::push(std::uint32_t e, double cost) {
    if (float(cost) <= most) queue.push(float(cost), e);
}

template <int N> bool Patch<N>::collapse_cheapest(Step& step) {
    while (!queue.empty()) {
        const std::uint32_t e = queue.pop(), c = half[e];
        if (c == none) continue;
        Placement to = place_edge(c);
        if (queue.comes_later(float(to.cost), e)) {
            push(e, to.cost);
            continue;
        }
        if (float(to.cost) > most) continue;
        if (keeps_volume) to.point = keep_volume(c, to.point);
        bool fits = allowed(c, to.point);
        if (!fits && crossed) {
            fits = evade(c, to);
            if (fits && queue.comes_later(float(to.cost), e)) {
                push(e, to.cost);
                continue;
            }
        }
        if (fits) {
            collapse(c, to, step);
            return true;
        }
        refuse(c);
    }
    return false;
}

/// `point`, moved square to the surface so far that the body keeps its volume (Lindstrom and Turk 1998, "Fast
/// and memory efficient polygonal simplification"): quadrics alone put every vertex of a curved surface
/// outside of it. Exact where flat.
template <int N> glm::dvec3 Patch<N>::keep_volume(std::uint32_t c, const glm::dvec3& point) const {
    const std::uint32_t a = at[c], b = after(c);
    glm::dvec3 normal(0);
    double area = 0, swept = 0;
    bool open = false;
    const auto add = [&](std::uint32_t h) {
        const std::uint32_t v = at[next(h)], w = at[previous(h)];
        open |= v == ghost || w == ghost;
        if (open) return;
        const glm::dvec3& x = position[at[h]];
        const glm::dvec3 n = cross(position[v] - x, position[w] - x);
        normal += n;
        area += length(n);
        swept += dot(n, x - point);
    };
    around(a, add);
    around(b, [&](std::uint32_t h) {
        if (after(h) != a && at[previous(h)] != a) add(h);
    });
    const double squared = dot(normal, normal);
    if (open || !(squared > flat_enough * flat_enough * area * area)) return point;
    return point + normal * (swept / squared);
}

/// The link condition, and never a tetrahedron: that would leave two triangles back to back.
template <int N> bool Patch<N>::keeps_manifold(std::uint32_t c) {
    const std::uint32_t a = at[c], b = after(c);
    ++marks;
    int valence = 0, common = 0;
    around(a, [&](std::uint32_t h) { mark[after(h)] = marks, ++valence; });
    around(b, [&](std::uint32_t h) { common += mark[after(h)] == marks, ++valence; });
    return common == 2 && valence > 6;
}

/// May the triangles around `v`, but for those that hold `other`, be led to `to` instead?
template <int N>
bool Patch<N>::keeps_shape(std::uint32_t v, std::uint32_t other, const glm::dvec3& to) const {
    const Strictness& rule = strictness[stage];
    const double squared_cosine = rule.min_cosine * rule.min_cosine,
                 least_quality = rule.min_quality * rule.min_quality;
    const glm::dvec3 from = position[v];
    std::uint32_t c = out[v];
    do {
        const std::uint32_t b = at[next(c)], d = at[previous(c)];
        if (b != other && d != other && b != ghost && d != ghost) {
            const glm::dvec3 &pb = position[b], &pd = position[d];
            const glm::dvec3 before = cross(pb - from, pd - from), now = cross(pb - to, pd - to);
            const double one = dot(before, before), two = dot(now, now), both = dot(before, now);
            if (both < 0 || both * both < squared_cosine * one * two) return false;
            const double good = squared_quality(to, pb, pd, two);
            if (good < least_quality && good < squared_quality(from, pb, pd, one)) return false;
        }
        c = twin[previous(c)];
    } while (c != out[v]);
    return true;
}

template <int N> bool Patch<N>::allowed(std::uint32_t c, const glm::dvec3& to) {
    crossed = false;
    if (!keeps_manifold(c)) return false;
    const std::uint32_t a = at[c], b = after(c);
    if (stage + 1 < std::size(strictness) && !(keeps_shape(a, b, to) && keeps_shape(b, a, to))) return false;
    if (!guard) return true;
    crossed = crosses(c, to);
    return !crossed;
}

/// Another place for an edge whose best one would let the surface pass through itself: the cheapest of some.
template <int N> bool Patch<N>::evade(std::uint32_t c, Placement& to) {
    const std::uint32_t a = at[c], b = after(c);
    Quadric<N> sum = quadrics[a];
    sum += quadrics[b];
    const PlaneQuadric q = sum.reduced();
    glm::dvec3 normal(0);
    for (const std::uint32_t v : {a, b})
        around(v, [&](std::uint32_t h) {
            if (at[next(h)] != ghost && at[previous(h)] != ghost)
                normal += cross(position[at[next(h)]] - position[v], position[at[previous(h)]] - position[v]);
        });
    const double size = length(normal), edge_length = length(position[a] - position[b]);
    if (size > 0) normal *= edge_length / size;
    const glm::dvec3 middle = (position[a] + position[b]) * 0.5;
    std::vector<Placement> places;
    for (const glm::dvec3& p : {position[a], position[b], middle}) places.push_back({p, q.at(p)});
    const glm::dvec3 best = to.point;
    for (const double d : {0.02, 0.05, 0.1, 0.2, 0.4})
        for (const double sign : {-1, 1})
            for (const glm::dvec3& base : {best, middle, position[a], position[b]}) {
                const glm::dvec3 p = base + normal * (sign * d);
                places.push_back({p, q.at(p)});
            }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& x, const auto& y) { return x.cost < y.cost; });
    places.resize(std::min(places.size(), most_places));
    for (const Placement& p : places)
        if (allowed(c, p.point)) {
            to = {p.point, std::max(to.cost, p.cost)};
            return true;
        }
    return false;
}

/// Would the surface pass through itself where the edge has become a vertex?
template <int N> bool Patch<N>::crosses(std::uint32_t c, const glm::dvec3& to) {
    const std::uint32_t removed = at[c], kept = after(c);
    change.replaced.clear();
    change.made.clear();
    change.moved = kept;
    change.to = to;
    const auto add = [&](std::uint32_t h, std::uint32_t gone) {
        const std::uint32_t v = at[next(h)], w = at[previous(h)];
        if (v == ghost || w == ghost) return;
        change.replaced.push_back(h / 3);
        if (v != gone && w != gone) change.made.push_back({kept, v, w});
    };
    around(removed, [&](std::uint32_t h) { add(h, kept); });
    around(kept, [&](std::uint32_t h) {
        if (after(h) != removed && at[previous(h)] != removed) add(h, removed);
    });
    return guard->crosses(guarded(), change);
}

template <int N> void Patch<N>::refuse(std::uint32_t c) {
    refused[edge[c]] = 1;
    near_refused[at[c]] = near_refused[after(c)] = 1;
}

/// The triangle of half-edge c, whose two other edges become one.
template <int N> void Patch<N>::remove_triangle(std::uint32_t c) {
    const std::uint32_t n = next(c), p = previous(c), one = twin[n], other = twin[p];
    const std::uint32_t lives = edge[n], dies = edge[p];
    twin[one] = other;
    twin[other] = one;
    if (dies != none) half[dies] = none;
    if (lives != none) half[lives] = one;
    edge[one] = edge[other] = lives;
    out[at[one]] = one; // from the far corner and
    out[at[other]] = other;
    at[c] = at[n] = at[p] = none;
}

/// The planes of the triangles as they were go out of the quadrics around an edge that becomes a vertex at
/// `to`, those of the triangles as they will be come in; quadrics[kept] has both ends' already. What
/// attributes and boundaries say stays.
template <int N> void Patch<N>::renew_planes(std::uint32_t c, const glm::dvec3& to) {
    const std::uint32_t removed = at[c], kept = after(c);
    for (const std::uint32_t v : {removed, kept})
        around(v, [&](std::uint32_t h) {
            const std::uint32_t x = at[next(h)], y = at[previous(h)], other = v == removed ? kept : removed;
            if (x == ghost || y == ghost) return;
            const bool goes = x == other || y == other;
            if (goes && v == kept) return; // seen from the other end
            PlaneQuadric change;
            change.add_triangle(position[v], position[x], position[y], -1);
            if (goes) {
                quadrics[x == other ? y : x].plane += change;
                quadrics[kept].plane += change; // once for each end
                quadrics[kept].plane += change;
                return;
            }
            change.add_triangle(to, position[x], position[y], 1);
            for (const std::uint32_t w : {kept, x, y}) quadrics[w].plane += change;
        });
}

template <int N> void Patch<N>::collapse(std::uint32_t c, const Placement& to, Step& step) {
    const std::uint32_t removed = at[c], kept = after(c), back = twin[c];
    const auto away = [&](std::uint32_t v) { return dot(source_at[v] - to.point, source_at[v] - to.point); };
    if (away(removed) < away(kept)) {
        source[kept] = source[removed];
        source_at[kept] = source_at[removed];
    }
    const bool at_boundary = at[previous(c)] == ghost || at[previous(back)] == ghost;
    step = {kept, removed, source[kept], float(to.cost), to.point, at_boundary};
    ++since_retry;
    quadrics[kept] += quadrics[removed];
    if (memoryless) renew_planes(c, to.point);
    position[kept] = to.point;
    std::uint32_t h = c;
    do {
        at[h] = kept;
        h = twin[previous(h)];
    } while (h != c);
    half[edge[c]] = none;
    remove_triangle(c);
    remove_triangle(back);
    if (guard) guard->made_it(guarded(), change);
    near_refused[kept] |= near_refused[removed];
    // What was refused near it may be allowed now.
    queue_at(kept);
    around(kept, [&](std::uint32_t near) { queue_at(after(near)); });
}

template <int N> void Patch<N>::queue_again(std::uint32_t e) {
    if (!refused[e] || half[e] == none) return;
    refused[e] = 0;
    push(e, place_edge(half[e]).cost);
}

template <int N> void Patch<N>::queue_at(std::uint32_t v) {
    if (!near_refused[v]) return;
    around(v, [&](std::uint32_t c) {
        if (edge[c] != none) queue_again(edge[c]);
    });
    near_refused[v] = 0;
}

template <int N> bool Patch<N>::relax() {
    // What was in a collapse's way may have gone with another one.
    if (since_retry == 0) {
        if (stage + 1 == std::size(strictness)) return false;
        ++stage;
    }
    since_retry = 0;
    for (std::uint32_t e = 0; e < half.size(); ++e) queue_again(e);
    return true;
}

template class Patch<0>;
template class Patch<3>;
template class Patch<6>;

} // namespace glcast
