#include "shim/preload/draw_places.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace glcast::preload {
namespace {

/// Of single precision, in what the sums of a vertex are made of: a hundred times what they round off.
constexpr double rounding = 0x1p-17;

glm::dmat4 magnitudes(const glm::dmat4& matrix) {
    glm::dmat4 result;
    for (int i = 0; i < 4; ++i) result[i] = glm::abs(matrix[i]);
    return result;
}

/// The place of one part, face by face.
class PlaceFinder {
  public:
    explicit PlaceFinder(const std::vector<glm::dvec3>& corners) : at(corners) {}

    Place find(GLenum mode, const glm::dvec3& slack) {
        for (const glm::dvec3& p : at) place.lo = glm::min(place.lo, p), place.hi = glm::max(place.hi, p);
        place.lo -= slack, place.hi += slack;
        faces(mode);
        return place;
    }

  private:
    void faces(GLenum mode) {
        const std::size_t n = at.size();
        switch (mode) {
        case GL_TRIANGLES:
            for (std::size_t i = 0; i + 2 < n; i += 3) triangle(i, i + 1, i + 2);
            break;
        case GL_QUADS:
            for (std::size_t i = 0; i + 3 < n; i += 4) quad(i, i + 1, i + 2, i + 3);
            break;
        case GL_TRIANGLE_STRIP:
            for (std::size_t i = 0; i + 2 < n; ++i) triangle(i, i + 1, i + 2);
            break;
        case GL_QUAD_STRIP:
            for (std::size_t i = 0; i + 3 < n; i += 2) quad(i, i + 1, i + 3, i + 2);
            break;
        case GL_TRIANGLE_FAN:
            for (std::size_t i = 1; i + 1 < n; ++i) triangle(0, i, i + 1);
            break;
        default: // a driver may cut it as it likes
            place.slope = glm::dvec3(INFINITY);
        }
    }

    /// Which way a driver cuts it is not known.
    void quad(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        triangle(a, b, c), triangle(a, c, d), triangle(a, b, d), triangle(b, c, d);
    }

    void triangle(std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 ab = at[b] - at[a], ac = at[c] - at[a], bc = at[c] - at[b];
        const double longest = std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}));
        const glm::dvec3 normal = glm::abs(glm::cross(ab, ac));
        const double length = glm::length(normal);
        for (int i = 0; i < 3; ++i) {
            const double slope = normal[i] > 0 ? length / normal[i] : INFINITY; // a little more than it is
            place.slope[i] = std::max(place.slope[i], slope);
            place.narrowest[i] = std::min(place.narrowest[i], longest > 0 ? normal[i] / longest : 0);
        }
    }

    const std::vector<glm::dvec3>& at;
    Place place = nowhere;
};

bool is_finite(const Place& place) {
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(place.lo[i]) || !std::isfinite(place.hi[i])) return false;
    return true;
}

} // namespace

std::optional<DrawPlace> find_place(const record::DrawParts& draw, const glm::dmat4& to_eye,
                                    const glm::dmat4& eye_to_capture) {
    const glm::dmat4 whole = eye_to_capture * to_eye;
    const bool is_affine = whole[0][3] == 0 && whole[1][3] == 0 && whole[2][3] == 0 && whole[3][3] == 1;
    if (!draw.is_known || !is_affine) return std::nullopt;
    const glm::dmat4 magnitude = magnitudes(eye_to_capture) * magnitudes(to_eye);
    DrawPlace result{{}, draw.is_whole};
    std::vector<float> xyz;
    std::vector<glm::dvec3> corners;
    for (const auto& part : draw.parts) {
        record::read_positions(part, xyz);
        corners.clear();
        glm::dvec3 largest(0);
        for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
            const glm::dvec3 p(xyz[i], xyz[i + 1], xyz[i + 2]);
            largest = glm::max(largest, glm::abs(p));
            corners.emplace_back(whole * glm::dvec4(p, 1));
        }
        const glm::dvec3 slack = rounding * glm::dvec3(magnitude * glm::dvec4(largest, 1));
        const Place place = PlaceFinder(corners).find(draw.mode, slack);
        if (!is_finite(place)) return std::nullopt;
        result.parts.push_back({part, place});
    }
    return result;
}

void DrawPlaces::begin(const glm::dmat4& eye_to_capture) {
    if (frame != eye_to_capture) *this = {};
    frame = eye_to_capture;
}

void DrawPlaces::note(const std::unique_ptr<std::optional<DrawPlace>>& place) {
    if (!*place) return;
    for (const DrawPlace::Part& part : (*place)->parts)
        all.lo = glm::min(all.lo, part.place.lo), all.hi = glm::max(all.hi, part.place.hi);
}

bool lies_inside(const DrawPlace& place, const Box& box) {
    const double margin =
        rounding * (box.size + std::max({std::abs(box.lo.x), std::abs(box.lo.y), std::abs(box.lo.z)}));
    for (const DrawPlace::Part& part : place.parts)
        for (int i = 0; i < 3; ++i)
            if (part.place.lo[i] <= box.lo[i] + margin || part.place.hi[i] >= box.lo[i] + box.size - margin)
                return false;
    return true;
}

} // namespace glcast::preload
