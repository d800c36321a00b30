// From samples to the units of the capture, in numbers that files hold exactly.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "capture/view.h"

namespace glcast {

/// Positions are rounded to a step that floats hold without rounding again (far from the origin: floats
/// relative to a whole-numbered point near by, as the writers do), so that what is checked here is what is in
/// the file.
class CaptureFrame {
  public:
    CaptureFrame(const Box& box, int n) : lo(box.lo), sample(box.size / n) {
        const glm::dvec3 far = glm::max(glm::abs(box.lo), glm::abs(box.lo + box.size));
        double reach = std::max({far.x, far.y, far.z});
        if (reach > 32 * box.size) reach = 4 * box.size;
        step = std::exp2(std::ceil(std::log2(reach)) - 24);
    }
    glm::dvec3 operator()(const glm::dvec3& samples) const {
        return glm::round((lo + (samples + 0.5) * sample) / step) * step;
    }
    /// The other way, not rounded.
    glm::dvec3 samples(const glm::dvec3& place) const { return (place - lo) / sample - 0.5; }
    /// How far a coordinate may move, samples.
    double rounding() const { return 0.5 * step / sample; }

  private:
    glm::dvec3 lo;
    double sample, step;
};

} // namespace glcast
