#include "tools/io/polygons.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "tools/mesh/predicates.h"

namespace glcast::format {
namespace {

constexpr std::size_t most_tests = 200'000'000; ///< of points in triangles, for one polygon: seconds

/// Twice the area as a vector (Newell), from the first corner, so that places far from the origin keep their digits.
glm::dvec3 area_vector(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners) {
    const glm::dvec3& from = positions[corners[0]];
    glm::dvec3 sum(0);
    for (std::size_t k = 2; k < corners.size(); ++k)
        sum += glm::cross(positions[corners[k - 1]] - from, positions[corners[k]] - from);
    return sum;
}

/// One polygon, seen along the axis that its normal is nearest to.
class Clipper {
  public:
    Clipper(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners)
        : positions(positions), corners(corners) {
        const glm::dvec3 area = area_vector(positions, corners), size = glm::abs(area);
        drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        side = area[drop] < 0 ? -1 : 1;
    }

    /// Does the fan from corner `first` cover the polygon, nothing turned over?
    bool fan(std::uint32_t first) const {
        const auto count = static_cast<std::uint32_t>(corners.size());
        const auto at = [&](std::uint32_t k) { return (first + k) % count; };
        for (std::uint32_t k = 2; k < count; ++k)
            if (turn(at(0), at(k - 1), at(k)) <= 0) return false;
        if (count <= 4) return true;
        for (std::uint32_t k = 0; k < count; ++k)
            if (turn(at(k), at(k + 1), at(k + 2)) < 0) return false;
        return turn(at(0), at(1), at(count - 1)) > 0;
    }

    void clip(std::vector<std::array<std::uint32_t, 3>>& picked) {
        const auto count = static_cast<std::uint32_t>(corners.size());
        for (std::uint32_t k = 0; k < count; ++k) before.push_back((k + count - 1) % count), after.push_back((k + 1) % count);
        gone.assign(count, false), bends.assign(count, false);
        for (std::uint32_t k = 0; k < count; ++k) classify(k);
        std::uint32_t at = 0;
        std::size_t left = count, tried = 0;
        while (left > 3) {
            // When all were tried the polygon passes through itself or has no area: any corner will do, flat ones first.
            const bool give_up = tried >= left;
            if (is_ear(at) || (give_up && (turn_at(at) == 0 || tried >= 2 * left))) {
                picked.push_back({before[at], at, after[at]});
                at = cut(at), --left, tried = 0;
            } else
                at = after[at], ++tried;
        }
        picked.push_back({before[at], at, after[at]});
    }

  private:
    int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return side * orient2d(place(a), place(b), place(c), drop);
    }
    const glm::dvec3& place(std::uint32_t k) const { return positions[corners[k]]; }
    int turn_at(std::uint32_t k) const { return turn(before[k], k, after[k]); }

    void classify(std::uint32_t k) {
        const bool now = turn_at(k) <= 0;
        if (now && !bends[k]) bent.push_back(k);
        bends[k] = now;
    }

    /// Only corners that are not convex can lie in an ear.
    bool is_ear(std::uint32_t b) {
        if (bends[b]) return false;
        const std::uint32_t a = before[b], c = after[b];
        for (std::size_t n = 0; n < bent.size();) {
            const std::uint32_t k = bent[n];
            if (gone[k] || !bends[k]) {
                bent[n] = bent.back(), bent.pop_back();
                continue;
            }
            ++n;
            if (++tests > most_tests)
                throw std::runtime_error("a face of " + std::to_string(corners.size()) +
                                         " corners is too tangled to be cut into triangles");
            const glm::dvec3& p = place(k);
            if (p == place(a) || p == place(b) || p == place(c)) continue; // a bridge to a hole
            if (turn(a, b, k) >= 0 && turn(b, c, k) >= 0 && turn(c, a, k) >= 0) return false;
        }
        return true;
    }

    /// The corner to go on from.
    std::uint32_t cut(std::uint32_t k) {
        const std::uint32_t a = before[k], c = after[k];
        gone[k] = true;
        after[a] = c, before[c] = a;
        classify(a), classify(c);
        return c;
    }

    std::span<const glm::dvec3> positions;
    std::span<const std::uint32_t> corners;
    int drop = 2, side = 1;
    std::vector<std::uint32_t> before, after; ///< of corners: neighbours among those that are left
    std::vector<bool> gone, bends;            ///< cut off; not convex
    std::vector<std::uint32_t> bent;          ///< all that bend, and some that did
    std::size_t tests = 0;
};

} // namespace

void cut_polygon(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& picked) {
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count < 3) return;
    if (count == 3) {
        picked.push_back({0, 1, 2});
        return;
    }
    Clipper clipper(positions, corners);
    for (const std::uint32_t first : {0u, 1u}) {
        if (first == 1 && count > 4) break;
        if (!clipper.fan(first)) continue;
        for (std::uint32_t k = 2; k < count; ++k)
            picked.push_back({first, (first + k - 1) % count, (first + k) % count});
        return;
    }
    clipper.clip(picked);
}

} // namespace glcast::format
