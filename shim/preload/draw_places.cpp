#include "shim/preload/draw_places.h"

#include <cmath>
#include <glm/common.hpp>

namespace glcast::preload {
namespace {

/// Of single precision, in what the sums of a vertex are made of: a hundred times what they round off.
constexpr double rounding = 0x1p-17;

glm::dmat4 magnitudes(const glm::dmat4& matrix) {
    glm::dmat4 result;
    for (int i = 0; i < 4; ++i) result[i] = glm::abs(matrix[i]);
    return result;
}

struct ToCapture {
    glm::dmat4 whole, magnitude;

    ToCapture(const glm::dmat4& to_eye, const glm::dmat4& eye_to_capture)
        : whole(eye_to_capture * to_eye), magnitude(magnitudes(eye_to_capture) * magnitudes(to_eye)) {}

    bool is_affine() const {
        return whole[0][3] == 0 && whole[1][3] == 0 && whole[2][3] == 0 && whole[3][3] == 1;
    }

    std::optional<Place> place(const record::Extent& extent) const {
        if (!extent.is_known()) return std::nullopt;
        Place place{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
        glm::dvec4 largest(0, 0, 0, 1);
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec4 p(0, 0, 0, 1);
            for (int i = 0; i < 3; ++i) {
                p[i] = corner >> i & 1 ? extent.hi[i] : extent.lo[i];
                largest[i] = std::max(largest[i], std::abs(p[i]));
            }
            const glm::dvec3 at(whole * p);
            place.lo = glm::min(place.lo, at), place.hi = glm::max(place.hi, at);
        }
        const glm::dvec3 slack = rounding * glm::dvec3(magnitude * largest);
        place.lo -= slack, place.hi += slack;
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(place.lo[i]) || !std::isfinite(place.hi[i])) return std::nullopt;
        return place;
    }
};

} // namespace

std::optional<DrawPlace> find_place(const record::DrawShape& shape, const glm::dmat4& to_eye,
                                    const glm::dmat4& eye_to_capture) {
    const ToCapture to_capture(to_eye, eye_to_capture);
    const auto all = to_capture.place(shape.extent);
    if (!all || !to_capture.is_affine()) return std::nullopt;
    DrawPlace result{*all, {}, shape.is_whole};
    for (const auto& part : shape.parts) {
        const auto place = to_capture.place(part.extent);
        if (!place) return std::nullopt;
        result.parts.push_back({part.first - shape.parts.front().first, part.count, *place});
    }
    return result;
}

void DrawPlaces::begin(const glm::dmat4& eye_to_capture) {
    if (frame != eye_to_capture) known.clear();
    frame = eye_to_capture;
}

std::optional<std::vector<ElementRange>> seen_parts(const DrawPlace& place, const OpenTiles& open) {
    std::vector<ElementRange> seen;
    if (!open.meet(place.all.lo, place.all.hi)) return seen;
    if (place.parts.empty()) return std::nullopt;
    for (const auto& part : place.parts) {
        if (!open.meet(part.place.lo, part.place.hi)) continue;
        const std::uint32_t end = part.first + part.count;
        if (!seen.empty() && seen.back().first + seen.back().count >= part.first)
            seen.back().count = end - seen.back().first;
        else
            seen.push_back({part.first, part.count});
    }
    return seen;
}

bool lies_inside(const DrawPlace& place, const Box& box) {
    const double margin = rounding * (box.size + std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z)}));
    for (int i = 0; i < 3; ++i)
        if (place.all.lo[i] <= box.lo[i] + margin || place.all.hi[i] >= box.lo[i] + box.size - margin) return false;
    return true;
}

} // namespace glcast::preload
