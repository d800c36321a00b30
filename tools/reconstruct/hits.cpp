#include "tools/reconstruct/hits.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

float fold(float a, float b) { return (1 - std::abs(b)) * (a >= 0 ? 1.0f : -1.0f); }

std::string name_of(const View& view) {
    const std::string name{view.side == Side::minus ? '-' : '+', "xyz"[static_cast<int>(view.axis)]};
    return view.layer ? name + "." + std::to_string(view.layer) : name;
}

std::uint32_t pack_drawn_normal(const glm::vec4& drawn) {
    const float length = glm::length(glm::vec3(drawn));
    return drawn.w > 0 && std::isfinite(length) && length > 1e-6f ? pack_normal(glm::vec3(drawn) / length)
                                                                  : 0;
}

/// Few entries, nearly sorted.
void sort_by_depth(AxisHits& hits, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = from + 1; i < to; ++i)
        for (std::uint32_t k = i; k > from && hits.depth[k] < hits.depth[k - 1]; --k) {
            std::swap(hits.depth[k], hits.depth[k - 1]);
            std::swap(hits.normal[k], hits.normal[k - 1]);
            std::swap(hits.colour[k], hits.colour[k - 1]);
            if (hits.plus_colour.empty()) continue;
            std::swap(hits.plus_normal[k], hits.plus_normal[k - 1]);
            std::swap(hits.plus_colour[k], hits.plus_colour[k - 1]);
        }
}

} // namespace

std::uint32_t pack_normal(const glm::vec3& unit) {
    const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
    float a = unit.x / sum, b = unit.y / sum;
    if (unit.z < 0) {
        const float folded = fold(a, b);
        b = fold(b, a);
        a = folded;
    }
    const auto quantise = [](float x) { return std::uint32_t(std::lround(x * 32767) + 32768); };
    return quantise(a) << 16 | quantise(b);
}

std::uint32_t pack_colour(const glm::vec3& colour) {
    const auto ten = [](float c) { return std::uint32_t(std::lround(std::clamp(c, 0.0f, 1.0f) * 1020)); };
    return ten(colour.r) << 20 | ten(colour.g) << 10 | ten(colour.b);
}

void HitBuilder::add(const ViewImage& image) {
    if (!n) n = image.n;
    if (image.n < min_resolution || image.n > max_resolution)
        throw std::runtime_error("resolution " + std::to_string(image.n) + " is not in " +
                                 std::to_string(min_resolution) + ".." + std::to_string(max_resolution));
    const std::size_t pixels = std::size_t(n) * n;
    if (image.n != n || image.depth.size() != pixels || image.colour.size() != pixels ||
        image.normal.size() != pixels)
        throw std::runtime_error("view " + name_of(image.view) + " has another size than the others");
    for (const Layer& other : added)
        if (other.view == image.view)
            throw std::runtime_error("view " + name_of(image.view) + " is there twice");
    Layer layer{image.view, {}, {}, {}, {}, {}, {}};
    const bool drawn_twice = image.other_colour.size() == pixels && image.other_normal.size() == pixels;
    both_sides |= drawn_twice || image.reversed_backs;
    for (std::size_t p = 0; p < pixels; ++p) {
        const float z = image.depth[p];
        if (!image.covered(p) || !(z >= 0 && z <= 1)) continue;
        layer.pixel.push_back(std::uint32_t(p));
        layer.depth.push_back(z * float(n) - 0.5f);
        layer.normal.push_back(pack_drawn_normal(image.normal[p]));
        layer.colour.push_back(pack_colour(glm::vec3(image.colour[p])));
        if (drawn_twice) {
            layer.other_normal.push_back(pack_drawn_normal(image.other_normal[p]));
            layer.other_colour.push_back(pack_colour(glm::vec3(image.other_colour[p])));
        } else if (image.reversed_backs) {
            layer.other_normal.push_back(pack_drawn_normal({-glm::vec3(image.normal[p]), image.normal[p].w}));
            layer.other_colour.push_back(layer.colour.back());
        }
    }
    layers |= image.view.layer > 0;
    added.push_back(std::move(layer));
}

AxisHits HitBuilder::merge(int axis) {
    std::vector<Layer> parts;
    for (Layer& layer : added)
        if (int(layer.view.axis) == axis) parts.push_back(std::move(layer));
    // Of two sides of a sheet at one depth the one that is seen from minus comes first.
    std::sort(parts.begin(), parts.end(), [](const Layer& a, const Layer& b) {
        return a.view.side != b.view.side ? a.view.side < b.view.side : a.view.layer < b.view.layer;
    });
    AxisHits hits;
    hits.start.assign(std::size_t(n) * n + 1, 0);
    for (const Layer& part : parts)
        for (std::uint32_t p : part.pixel) ++hits.start[p + 1];
    for (std::size_t p = 1; p < hits.start.size(); ++p) hits.start[p] += hits.start[p - 1];
    const std::size_t count = hits.start.back();
    hits.depth.resize(count);
    hits.normal.resize(count);
    hits.colour.resize(count);
    if (both_sides) hits.plus_normal.resize(count), hits.plus_colour.resize(count);
    std::vector<std::uint32_t> next(hits.start.begin(), hits.start.end() - 1);
    for (Layer& part : parts) {
        for (std::size_t i = 0; i < part.pixel.size(); ++i) {
            const std::uint32_t to = next[part.pixel[i]]++;
            hits.depth[to] = part.depth[i];
            hits.normal[to] = part.normal[i];
            hits.colour[to] = part.colour[i];
            if (!both_sides) continue;
            const bool from_plus = part.view.side == Side::plus, has_other = !part.other_colour.empty();
            hits.plus_normal[to] = from_plus || !has_other ? part.normal[i] : part.other_normal[i];
            hits.plus_colour[to] = from_plus || !has_other ? part.colour[i] : part.other_colour[i];
            if (!from_plus || !has_other) continue;
            hits.normal[to] = part.other_normal[i];
            hits.colour[to] = part.other_colour[i];
        }
        part = {};
    }
    tbb::parallel_for(0, n, [&](int v) {
        for (std::size_t p = std::size_t(v) * n; p < std::size_t(v + 1) * n; ++p)
            sort_by_depth(hits, hits.start[p], hits.start[p + 1]);
    });
    return hits;
}

std::array<AxisHits, 3> HitBuilder::finish() {
    if (added.empty()) throw std::runtime_error("the capture has no views");
    for (int i = 0; i < 6; ++i) {
        const View wanted{Axis(i / 2), Side(i % 2), 0};
        if (std::none_of(added.begin(), added.end(), [&](auto& layer) { return layer.view == wanted; }))
            throw std::runtime_error("the capture has no view " + name_of(wanted));
    }
    std::array<AxisHits, 3> out;
    for (int axis = 0; axis < 3; ++axis) out[axis] = merge(axis);
    added.clear();
    return out;
}

} // namespace glcast
