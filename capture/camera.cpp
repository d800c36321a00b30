#include "capture/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace glcast {
namespace {

constexpr double most_skew = 1e-4;
constexpr double rounding = 1e-6; ///< of matrices of floats, multiplied

glm::dvec3 row(const glm::dmat4& m, int r) { return {m[0][r], m[1][r], m[2][r]}; }

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool all_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[column][r])) return false;
    return true;
}

/// Only `at` of a row, and what it may have in z, is more than rounding.
bool along(const glm::dvec3& r, int at, bool z_too) {
    const int other = 1 - at;
    return std::abs(r[other]) <= rounding * std::abs(r[at]) && r[at] != 0 &&
           (z_too || std::abs(r.z) <= rounding * std::abs(r[at]));
}

std::optional<Camera> plain_perspective(const glm::dmat4& p) {
    const glm::dvec3 r4 = row(p, 3);
    const double size = std::abs(r4.z);
    if (!(size > 0) || r4.x != 0 || r4.y != 0 || p[3][3] != 0 || p[3][0] != 0 || p[3][1] != 0)
        return std::nullopt;
    const glm::dvec3 r1 = row(p, 0), r2 = row(p, 1);
    if (!along(r1, 0, true) || !along(r2, 1, true)) return std::nullopt;
    Camera camera;
    camera.lens.fx = r1.x / size, camera.lens.fy = r2.y / size;
    camera.lens.sx = -r1.z / r4.z, camera.lens.sy = -r2.z / r4.z;
    if (r4.z > 0) camera.to_eye[2][2] = -1;
    return camera;
}

std::optional<Camera> plain_parallel(const glm::dmat4& p) {
    const glm::dvec3 r3 = row(p, 2);
    if (!along(row(p, 0), 0, false) || !along(row(p, 1), 1, false) || r3.x != 0 || r3.y != 0 || r3.z == 0)
        return std::nullopt;
    Camera camera;
    camera.lens.perspective = false;
    camera.lens.fx = p[0][0] / p[3][3], camera.lens.fy = p[1][1] / p[3][3];
    camera.lens.sx = -p[3][0] / p[3][3], camera.lens.sy = -p[3][1] / p[3][3];
    camera.lens.fz = std::abs(r3.z / p[3][3]);
    if (r3.z / p[3][3] > 0) camera.to_eye[2][2] = -1;
    return camera;
}

/// Squares of fx and fy as `r1`, `r2`, `r4` give them.
std::optional<Lens> perspective_lens(const glm::dmat4& m) {
    const glm::dvec3 r1 = row(m, 0), r2 = row(m, 1), r4 = row(m, 3);
    const double s2 = glm::dot(r4, r4);
    if (!(s2 > 0)) return std::nullopt;
    Lens lens;
    lens.sx = -glm::dot(r1, r4) / s2, lens.sy = -glm::dot(r2, r4) / s2;
    const double fx2 = glm::dot(r1, r1) / s2 - lens.sx * lens.sx,
                 fy2 = glm::dot(r2, r2) / s2 - lens.sy * lens.sy;
    if (!(fx2 > rounding * lens.sx * lens.sx) || !(fy2 > rounding * lens.sy * lens.sy)) return std::nullopt;
    lens.fx = std::sqrt(fx2), lens.fy = std::sqrt(fy2);
    const double skew = (glm::dot(r1, r2) / s2 - lens.sx * lens.sy) / (lens.fx * lens.fy);
    if (!(std::abs(skew) < most_skew)) return std::nullopt;
    return lens;
}

std::optional<Camera> combined_parallel(const glm::dmat4& m) {
    const glm::dvec3 rows[] = {row(m, 0), row(m, 1), row(m, 2)};
    glm::dvec3 length;
    for (int i = 0; i < 3; ++i) length[i] = glm::length(rows[i]);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (!(length[i] > 0) || !(std::abs(glm::dot(rows[i], rows[j])) < most_skew * length[i] * length[j]))
            return std::nullopt;
    }
    Camera camera;
    camera.plain = false;
    camera.lens = {false, length.x / m[3][3], length.y / m[3][3], 0, 0, length.z / m[3][3]};
    for (int r = 0; r < 3; ++r) {
        const double sign = r == 2 ? -1 : 1;
        for (int column = 0; column < 4; ++column) camera.to_eye[column][r] = sign * m[column][r] / length[r];
    }
    return camera;
}

} // namespace

bool is_projective(const glm::dmat4& m) {
    const double size = std::max({largest_of(row(m, 0)), largest_of(row(m, 1)), largest_of(row(m, 2))});
    return !(largest_of(row(m, 3)) <= rounding * std::min(1.0, size));
}

std::optional<Camera> find_camera(const glm::dmat4& m) {
    if (!all_finite(m)) return std::nullopt;
    if (row(m, 3) == glm::dvec3(0)) {
        if (!(m[3][3] > 0)) return std::nullopt;
        const auto plain = plain_parallel(m);
        return plain ? plain : combined_parallel(m);
    }
    if (const auto plain = plain_perspective(m)) return plain;
    const auto lens = perspective_lens(m);
    if (!lens) return std::nullopt;
    return with_lens(m, *lens);
}

std::optional<Camera> find_camera_of_stretched(const glm::dmat4& m) {
    if (!all_finite(m)) return std::nullopt;
    // h_i . diag(a, b, 1) h_j = 0 for three pairs of columns: least squares for a and b.
    double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
    glm::dvec3 columns[3];
    for (int i = 0; i < 3; ++i) {
        columns[i] = {m[i][0], m[i][1], m[i][3]};
        const double length = glm::length(columns[i]);
        if (!(length > 0)) return std::nullopt;
        columns[i] /= length;
    }
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 product = columns[i] * columns[(i + 1) % 3];
        aa += product.x * product.x, ab += product.x * product.y, bb += product.y * product.y;
        ac -= product.x * product.z, bc -= product.y * product.z;
    }
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-8 * std::max(aa, bb) * std::max(aa, bb))) return std::nullopt;
    const double a = (ac * bb - bc * ab) / determinant, b = (bc * aa - ac * ab) / determinant;
    if (!(a > 0 && b > 0)) return std::nullopt;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 product = columns[i] * columns[(i + 1) % 3];
        const double size = std::abs(a * product.x) + std::abs(b * product.y) + std::abs(product.z);
        if (!(std::abs(a * product.x + b * product.y + product.z) <= most_skew * size)) return std::nullopt;
    }
    Lens lens;
    lens.fx = 1 / std::sqrt(a), lens.fy = 1 / std::sqrt(b);
    return with_lens(m, lens);
}

Camera with_lens(const glm::dmat4& m, const Lens& lens) {
    Camera camera;
    camera.plain = false;
    camera.lens = lens;
    camera.to_eye = clip_to_eye(lens) * m;
    camera.to_eye[3][3] += 1;
    return camera;
}

std::optional<DepthLine> find_depth_line(const glm::dmat4& m) {
    const glm::dvec3 r3 = row(m, 2), r4 = row(m, 3);
    const double s2 = glm::dot(r4, r4);
    if (!(s2 > 0)) {
        if (r3.x != 0 || r3.y != 0 || !(m[3][3] > 0)) return std::nullopt;
        return DepthLine{r3.z / m[3][3], m[3][2] / m[3][3]};
    }
    DepthLine line;
    line.slope = glm::dot(r3, r4) / s2;
    line.shift = m[3][2] - line.slope * m[3][3];
    const double apart = glm::length(r3 - line.slope * r4);
    if (!(apart <= 1e-5 * (glm::length(r3) + std::sqrt(s2))) || !std::isfinite(line.shift))
        return std::nullopt;
    return line;
}

bool same_line(const DepthLine& a, const DepthLine& b) {
    return std::abs(a.slope - b.slope) <= 1e-5 * (1 + std::abs(a.slope)) &&
           std::abs(a.shift - b.shift) <= 1e-3 * (std::abs(a.shift) + std::abs(b.shift));
}

bool same_eye(const Lens& a, const Lens& b) {
    if (a.perspective != b.perspective || a.fx * b.fx <= 0 || a.fy * b.fy <= 0) return false;
    const double x = a.fx / b.fx, y = a.fy / b.fy;
    if (!a.perspective) {
        constexpr double same = 1e-5;
        return std::abs(x - 1) < same && std::abs(y - 1) < same && std::abs(a.sx - b.sx) < same &&
               std::abs(a.sy - b.sy) < same;
    }
    constexpr double same_centre = 1e-4, same_shape = 5e-3;
    return std::abs(a.sx - b.sx) < same_centre && std::abs(a.sy - b.sy) < same_centre &&
           std::abs(x / y - 1) < same_shape;
}

namespace {

bool all_but_same(const glm::dmat4& a, const glm::dmat4& b) {
    double size = 0, apart = 0;
    for (int r = 0; r < 3; ++r) {
        size = std::max(size, largest_of(row(b, r)));
        apart = std::max(apart, largest_of(row(a, r) - row(b, r)));
    }
    const glm::dvec3 from(a[3]), to(b[3]);
    const double far = std::max(largest_of(from), largest_of(to));
    return apart <= rounding * size && largest_of(from - to) <= rounding * far + 1e-9 * size;
}

/// Of two parallel cameras that are not plain: `camera` under the lens of `reference`, where only the size
/// differs.
std::optional<glm::dmat4> under_lens_of(const Camera& reference, const Camera& camera) {
    constexpr double same = 1e-3;
    const double x = camera.lens.fx / reference.lens.fx, y = camera.lens.fy / reference.lens.fy,
                 z = camera.lens.fz / reference.lens.fz;
    if (!(std::abs(x - y) < same * x)) return std::nullopt;
    if (!(std::abs(x - z) < same * x)) {
        // Other near and far planes before the same view.
        glm::dmat4 turned = camera.to_eye;
        for (int column = 0; column < 4; ++column) turned[column][2] = reference.to_eye[column][2];
        if (!(std::abs(x - 1) < same) || !all_but_same(turned, reference.to_eye)) return std::nullopt;
        return turned;
    }
    glm::dmat4 sized = camera.to_eye;
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 3; ++r) sized[column][r] *= x;
    return sized;
}

} // namespace

std::optional<glm::dmat4> to_space_of(const Camera& reference, const Camera& camera) {
    std::optional<glm::dmat4> eye = camera.to_eye;
    const bool built_alike = reference.plain == camera.plain;
    if (!reference.lens.perspective && !camera.lens.perspective && built_alike && !camera.plain)
        eye = under_lens_of(reference, camera);
    else if (!same_eye(reference.lens, camera.lens) || !(built_alike || camera.lens.perspective))
        return std::nullopt;
    if (!eye) return std::nullopt;
    if (all_but_same(*eye, reference.to_eye)) return glm::dmat4(1.0);
    const glm::dmat4 between = glm::inverse(reference.to_eye) * *eye;
    if (!all_finite(between)) return std::nullopt;
    return between;
}

double depth_nudge(const DepthLine& reference, const DepthLine& nudged, bool perspective) {
    constexpr double least = 2e-6, most = 2e-3; // less is rounding
    const auto is_nudge = [](double moved) { return std::abs(moved) >= least && std::abs(moved) <= most; };
    if (!perspective) {
        const double moved = nudged.shift - reference.shift;
        const bool same_slope =
            std::abs(nudged.slope - reference.slope) <= rounding * std::abs(reference.slope);
        return same_slope && is_nudge(moved) ? moved / 2 : 0;
    }
    // Where the near plane is, so that a far plane moved by much is no nudge.
    const double near = -reference.shift / (reference.slope + 1);
    const auto moved_at = [&](double w) {
        return nudged.slope - reference.slope + (nudged.shift - reference.shift) / w;
    };
    const double moved = moved_at(10 * near);
    return is_nudge(moved_at(2 * near)) && is_nudge(moved) ? moved / 2 : 0;
}

bool is_square(const Lens& lens, int width, int height) {
    constexpr double tolerance = 5e-3;
    return std::abs(std::abs(lens.fx) * width / (std::abs(lens.fy) * height) - 1) < tolerance;
}

glm::dmat4 clip_to_eye(const Lens& lens) {
    glm::dmat4 rows(0.0);
    rows[0][0] = 1 / lens.fx, rows[3][0] = lens.sx / lens.fx;
    rows[1][1] = 1 / lens.fy, rows[3][1] = lens.sy / lens.fy;
    rows[3][2] = -1;
    return rows;
}

glm::dmat4 projection_of(const Lens& lens, const DepthLine& depth) {
    glm::dmat4 p(0.0);
    p[0][0] = lens.fx, p[2][0] = lens.sx;
    p[1][1] = lens.fy, p[2][1] = lens.sy;
    p[2][2] = -depth.slope, p[3][2] = depth.shift;
    p[2][3] = -1;
    return p;
}

Lens lens_of_view(double degrees, int width, int height) {
    Lens lens;
    lens.fy = 1 / std::tan(glm::radians(degrees) / 2);
    lens.fx = width > 0 ? lens.fy * height / width : lens.fy;
    return lens;
}

bool is_mirrored(const Camera& camera) {
    return camera.lens.fx * camera.lens.fy * glm::determinant(glm::dmat3(camera.to_eye)) < 0;
}

std::optional<glm::dvec3> find_scale_of_rows(const glm::dmat4& m) {
    if (!all_finite(m) || is_projective(m)) return std::nullopt;
    constexpr double perpendicular = 1e-4, clearly = 1e-3, flat = 1e-6;
    glm::dvec3 length;
    for (int r = 0; r < 3; ++r) length[r] = glm::length(row(m, r));
    const double longest = largest_of(length), shortest = std::min({length.x, length.y, length.z});
    if (!(shortest > flat * longest) || longest - shortest < clearly * longest) return std::nullopt;
    double columns = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (std::abs(glm::dot(row(m, i), row(m, j))) > perpendicular * length[i] * length[j])
            return std::nullopt;
        const glm::dvec3 a(m[i]), b(m[j]);
        columns = std::max(columns, std::abs(glm::dot(a, b)) / (glm::length(a) * glm::length(b)));
    }
    if (!(columns > clearly)) return std::nullopt;
    if (glm::determinant(glm::dmat3(m)) < 0) length.z = -length.z;
    return length;
}

void DepthLineFit::add(double w, double z) {
    ++count;
    const double dw = w - mean_w, dz = z - mean_z;
    mean_w += dw / double(count), mean_z += dz / double(count);
    ww += dw * (w - mean_w), wz += dw * (z - mean_z), zz += dz * (z - mean_z);
    largest = std::max({largest, std::abs(w), std::abs(z)});
    behind |= !(w > 0);
}

bool DepthLineFit::varies() const { return count > 1 && ww / double(count) > 1e-10 * largest * largest; }

std::optional<DepthLine> DepthLineFit::line() const {
    constexpr double noise = 2e-6;
    if (!varies() || behind) return std::nullopt;
    const double slope = wz / ww, residual = std::max(0.0, zz - slope * wz) / double(count);
    const DepthLine line{slope, mean_z - slope * mean_w};
    if (!std::isfinite(slope) || !(std::sqrt(residual) <= noise * largest)) return std::nullopt;
    if (!(std::abs(line.shift) > 10 * noise * largest)) return std::nullopt;
    return line;
}

} // namespace glcast
