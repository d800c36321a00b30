#include "capture/depth_offset.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/type_ptr.hpp>

namespace glcast {

namespace {

/// Depth ranges that differ by more part a scene into a sky, a world and a weapon, and are no offsets.
constexpr double most_trimmed = 0.05;

} // namespace

double OffsetLevels::level_of(const OffsetState& state, bool reversed) {
    double level = state.enabled ? double(state.factor) + double(state.units) : 0;
    const bool trimmed = std::abs(state.near) <= most_trimmed && std::abs(state.far - 1) <= most_trimmed;
    if (trimmed) level += (state.near + state.far - 1) / 2 * units_of_depth;
    if (!std::isfinite(level)) return 0;
    return reversed ? -level : level;
}

void OffsetLevels::note(double level) {
    const auto at = std::lower_bound(levels.begin(), levels.end(), level, std::greater<>());
    if (at == levels.end() || *at != level) levels.insert(at, level);
}

int OffsetLevels::steps(double level) const {
    if (!several()) return 0;
    const auto at = std::lower_bound(levels.begin(), levels.end(), level, std::greater<>());
    const auto rank = std::min<std::ptrdiff_t>(at - levels.begin(), std::ssize(levels) - 1);
    const auto highest = std::ssize(levels) - 1;
    if (highest <= most_steps) return static_cast<int>(rank);
    return static_cast<int>((rank * most_steps + highest / 2) / highest);
}

void DepthShift::apply(const GlTable& gl, int steps, GLenum matrix_mode) const {
    glm::dmat4 shifted = projection;
    for (int column = 0; column < 4; ++column)
        shifted[column][2] += steps * clip_step * projection[column][3];
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadMatrixd(glm::value_ptr(shifted));
    gl.MatrixMode(matrix_mode);
    const float times = static_cast<float>(steps);
    if (offset_clamp) offset_clamp(times * slope_step, 0, times * slope_most);
    steps&& offset_clamp ? gl.Enable(GL_POLYGON_OFFSET_FILL) : gl.Disable(GL_POLYGON_OFFSET_FILL);
}

} // namespace glcast
