#include "shim/preload/draw_places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

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
    explicit PlaceFinder(std::span<const glm::dvec3> corners) : at(corners) {}

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

    const std::span<const glm::dvec3> at;
    Place place = nowhere;
};

/// A part of the draw that is played, in the capture frame.
class PartCorners {
  public:
    explicit PartCorners(const DrawPlace& of) : draw(of) {}

    void read(const record::DrawParts::Part& part) {
        record::read_positions(part, xyz);
        corners.clear();
        glm::dvec3 largest(0);
        for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
            const glm::dvec3 p(xyz[i], xyz[i + 1], xyz[i + 2]);
            largest = glm::max(largest, glm::abs(p));
            corners.emplace_back(draw.to_capture * glm::dvec4(p, 1));
        }
        slack = rounding * glm::dvec3(draw.magnitude * glm::dvec4(largest, 1));
    }

    /// `visit(first, corners)` for each primitive, or pair of triangles in a strip; for all at once where the
    /// draw cannot be taken apart.
    template <class Visit> void each_primitive(const Visit& visit) const {
        const Step step = step_of(draw.is_whole ? draw.mode : GL_POLYGON, corners.size());
        const std::span<const glm::dvec3> all(corners);
        for (std::size_t at = 0; at + step.least <= all.size(); at += step.by)
            visit(static_cast<std::uint32_t>(at), all.subspan(at, std::min(step.most, all.size() - at)));
    }

    std::vector<glm::dvec3> corners;
    glm::dvec3 slack{0};

  private:
    struct Step {
        std::size_t by, least, most;
    };
    static Step step_of(GLenum mode, std::size_t all) {
        switch (mode) {
        case GL_TRIANGLES:
            return {3, 3, 3};
        case GL_QUADS:
            return {4, 4, 4};
        case GL_TRIANGLE_STRIP: // from even places on, as parts are cut
            return {2, 3, 4};
        case GL_QUAD_STRIP:
            return {2, 4, 4};
        default:
            return {all, all, all};
        }
    }

    const DrawPlace& draw;
    std::vector<float> xyz;
};

bool has_centre(const OpenTiles& tiles, std::span<const glm::dvec3> corners, const glm::dvec3& slack) {
    glm::dvec3 lo = corners[0], hi = lo;
    for (const glm::dvec3& p : corners.subspan(1)) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return tiles.has_centre(lo - slack, hi + slack);
}

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
    DrawPlace result{{}, draw.is_whole, draw.mode, whole, magnitudes(eye_to_capture) * magnitudes(to_eye)};
    PartCorners read(result);
    for (const auto& part : draw.parts) {
        read.read(part);
        const Place place = PlaceFinder(read.corners).find(draw.mode, read.slack);
        if (!is_finite(place)) return std::nullopt;
        result.parts.push_back({part, place});
    }
    return result;
}

DrawCover find_cover(const DrawPlace& place, const OpenTiles& tiles) {
    DrawCover result;
    PartCorners read(place);
    for (const DrawPlace::Part& part : place.parts) {
        const auto cover = tiles.cover_of(part.place);
        if (!cover) continue;
        read.read(part);
        const std::size_t before = result.pieces.size();
        std::size_t all = 0;
        read.each_primitive([&](std::uint32_t at, std::span<const glm::dvec3> corners) {
            ++all;
            if (!has_centre(tiles, corners, read.slack)) return;
            const auto one = tiles.cover_of(PlaceFinder(corners).find(place.mode, read.slack));
            if (one) result.pieces.push_back({{part.first + at, std::uint32_t(corners.size())}, *one});
        });
        // Most of it: in one piece it costs less to ask for.
        if ((result.pieces.size() - before) * 4 <= all * 3) continue;
        result.pieces.resize(before);
        result.pieces.push_back({part, *cover});
    }
    return result;
}

std::vector<DrawPlace::Part> primitives_of(const DrawPlace& place, const record::DrawParts::Part& part) {
    std::vector<DrawPlace::Part> result;
    PartCorners read(place);
    read.read(part);
    read.each_primitive([&](std::uint32_t at, std::span<const glm::dvec3> corners) {
        result.push_back({{part.first + at, std::uint32_t(corners.size())},
                          PlaceFinder(corners).find(place.mode, read.slack)});
    });
    return result;
}

std::vector<DrawPlace::Part> vertices_of(const DrawPlace& place, const record::DrawParts::Part& part) {
    std::vector<DrawPlace::Part> result;
    PartCorners read(place);
    read.read(part);
    Place at = nowhere;
    for (std::uint32_t i = 0; i < part.count; ++i) {
        at.lo = read.corners[i] - read.slack, at.hi = read.corners[i] + read.slack;
        result.push_back({{part.first + i, 1}, at});
    }
    return result;
}

const DrawCover& DrawPlaces::cover_of(std::size_t draw, const DrawPlace& place, const OpenTiles& tiles) {
    if (grid != tiles.grid()) covers.clear();
    grid = tiles.grid();
    if (draw >= covers.size()) covers.resize(draw + 1);
    if (!covers[draw]) covers[draw] = std::make_unique<const DrawCover>(find_cover(place, tiles));
    return *covers[draw];
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
