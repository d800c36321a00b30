// What is seen of a picture between its pixels.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tools/mesh/picture.h"

namespace glcast {

/// Bilinear, (0, 0) the top left corner of the picture and (1, 1) the bottom right one; the edge goes on
/// outside. 0..1. The picture must not be empty, the coordinates finite.
inline glm::vec3 sample(const Picture& picture, const glm::vec2& at) {
    const auto place = [](double share, int size) {
        return std::clamp(share * size - 0.5, 0.0, double(size - 1));
    };
    const double x = place(at.x, picture.width), y = place(at.y, picture.height);
    const int left = int(x), top = int(y), right = std::min(left + 1, picture.width - 1),
              bottom = std::min(top + 1, picture.height - 1);
    const auto pixel = [&](int i, int j) {
        const std::uint8_t* p =
            picture.rgb.data() + (std::size_t(j) * std::size_t(picture.width) + std::size_t(i)) * 3;
        return glm::vec3(p[0], p[1], p[2]);
    };
    const float u = float(x - left), v = float(y - top);
    return glm::mix(glm::mix(pixel(left, top), pixel(right, top), u),
                    glm::mix(pixel(left, bottom), pixel(right, bottom), u), v) /
           255.0f;
}

} // namespace glcast
