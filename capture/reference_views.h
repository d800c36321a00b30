// Views of a scene that its capture does not have: the same frame under turned capture frames. What a level
// of detail looks like is judged by them, as no pixel of them took part in making it.
#pragma once
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/view.h"

namespace glcast {

inline constexpr int max_reference_views = 36;

/// Rotations of the capture frame, six views each, that make at least `views` (1..36) views. Of the 36, as of
/// the six of the capture with them, no two look along lines that are less than 27 degrees apart, but for
/// opposite ones.
std::vector<glm::dmat4> reference_rotations(int views);

/// A cube round the turned box: where the search for the box of the turned views begins.
Box turned_box(const Box& box, const glm::dmat4& rotation);

/// "a.exr", 1: "a.reference-1.exr". Counted from 1.
std::string reference_name(const std::string& capture, int number);

} // namespace glcast
