#include "capture/reference_views.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace glcast {
namespace {

constexpr int views_each = 6;

/// w, x, y, z. Found by search: the least angle between any two of the 21 lines (these and the capture's own
/// three) as large as it would go.
constexpr double quaternions[][4] = {
    {0.4685, -0.0001, 0.6270, -0.6223}, {0.7069, -0.3335, -0.0019, 0.6238},
    {0.0010, -0.3311, -0.7094, 0.6222}, {0.4405, -0.4414, 0.2673, -0.7346},
    {0.2223, -0.0927, 0.3730, -0.8961}, {0.4984, -0.1257, -0.2059, -0.8327},
};
static_assert(std::size(quaternions) * views_each == max_reference_views);

} // namespace

std::vector<glm::dmat4> reference_rotations(int views) {
    const int count = (std::clamp(views, 1, max_reference_views) + views_each - 1) / views_each;
    std::vector<glm::dmat4> rotations;
    for (const auto& q : quaternions)
        if (int(rotations.size()) < count)
            rotations.push_back(glm::mat4_cast(glm::normalize(glm::dquat(q[0], q[1], q[2], q[3]))));
    return rotations;
}

Box turned_box(const Box& box, const glm::dmat4& rotation) {
    const glm::dvec3 centre(rotation * glm::dvec4(box.lo + 0.5 * box.size, 1));
    const double size = box.size * std::sqrt(3.0);
    return {centre - 0.5 * size, size};
}

std::string reference_name(const std::string& capture, int number) {
    const std::string ending = ".exr", part = ".reference-" + std::to_string(number) + ending;
    return (capture.ends_with(ending) ? capture.substr(0, capture.size() - ending.size()) : capture) + part;
}

} // namespace glcast
