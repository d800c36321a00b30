#include "tools/simplify/sample_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace glcast {
namespace {

constexpr double hardly_farther = 2; // spacings
constexpr double least_cosine = 0.7; // of normals that agree

} // namespace

double SampleTree::Box::squared_distance(const glm::dvec3& point) const {
    const glm::dvec3 off = point - glm::clamp(point, low, high);
    return glm::dot(off, off);
}

SampleTree::SampleTree(std::span<const Sample> of, double apart, const SurfaceWalk& walk)
    : samples(of), spacing(apart), surface(walk), order(of.size()) {
    std::iota(order.begin(), order.end(), 0);
    boxes.resize(2 * std::bit_ceil((order.size() + leaf_size - 1) / leaf_size));
    build(1, 0, order.size());
}

void SampleTree::build(std::size_t node, std::size_t first, std::size_t last) {
    Box box{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (std::size_t i = first; i < last; ++i) {
        box.low = glm::min(box.low, samples[order[i]].at);
        box.high = glm::max(box.high, samples[order[i]].at);
    }
    boxes[node] = box;
    if (2 * node >= boxes.size()) return;
    const glm::dvec3 size = box.high - box.low;
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t i) { return order.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
        return samples[a].at[axis] != samples[b].at[axis] ? samples[a].at[axis] < samples[b].at[axis] : a < b;
    });
    build(2 * node, first, middle);
    build(2 * node + 1, middle, last);
}

double SampleTree::squared(std::uint32_t sample, const glm::dvec3& point) const {
    const glm::dvec3 off = samples[sample].at - point;
    return glm::dot(off, off);
}

template <typename Counts>
void SampleTree::search(const glm::dvec3& point, std::uint32_t& near, double& within,
                        const Counts& counts) const {
    struct Part {
        std::size_t node, first, last;
        double squared;
    };
    Part stack[64];
    std::size_t depth = 0;
    stack[depth++] = {1, 0, order.size(), boxes[1].squared_distance(point)};
    while (depth) {
        const Part part = stack[--depth];
        if (!(part.squared < within)) continue;
        if (2 * part.node >= boxes.size()) {
            for (std::size_t i = part.first; i < part.last; ++i)
                if (const double d = squared(order[i], point); d < within && counts(order[i])) {
                    within = d;
                    near = order[i];
                }
            continue;
        }
        const std::size_t middle = (part.first + part.last) / 2;
        const Part left{2 * part.node, part.first, middle, boxes[2 * part.node].squared_distance(point)},
            right{2 * part.node + 1, middle, part.last, boxes[2 * part.node + 1].squared_distance(point)};
        const bool left_first = left.squared < right.squared;
        stack[depth++] = left_first ? right : left;
        stack[depth++] = left_first ? left : right;
    }
}

glm::dvec3 SampleTree::way_to_surface(const glm::dvec3& point, const glm::dvec3& facing,
                                      std::uint32_t& near) const {
    const auto agrees = [&](std::uint32_t sample) {
        return glm::dot(facing, samples[sample].normal) > least_cosine;
    };
    double of_all = squared(near, point);
    search(point, near, of_all, [](std::uint32_t) { return true; });
    if (!agrees(near)) {
        double within = std::sqrt(of_all) + hardly_farther * spacing;
        within *= within;
        search(point, near, within, agrees);
    }
    const glm::dvec3 off = samples[near].at - point;
    glm::dvec3 up(0); // where none agrees, its plane may end in between, at a crease
    if (agrees(near)) up = glm::dot(off, samples[near].normal) * samples[near].normal;
    const glm::dvec3 along = off - up;
    // A way along the surface would draw in what lies on a crease, or a corner, that no sample is near.
    if (glm::dot(along, along) > spacing * spacing)
        return surface.nearest_point(point, samples[near].on) - point;
    return up;
}

} // namespace glcast
