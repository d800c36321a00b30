// Pictures as files, in memory.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tools/mesh/picture.h"

namespace glcast {

/// PNG (ISO 15948) of 8 bits. `channels`: 3 is RGB, 4 RGBA; row 0 on top, width * height * channels bytes.
/// The same picture gives the same bytes. Throws std::runtime_error on an empty picture, or one of another
/// size than it says.
std::string png_bytes(int width, int height, int channels, std::span<const std::uint8_t> pixels);
std::string png_bytes(const Picture& picture);

inline constexpr int largest_picture =
    16384; ///< pixels a side that decode_picture() takes; 64 million in all

/// A PNG or JPEG as RGB. Throws std::runtime_error on anything else, on damage, and on a picture that is
/// larger than its bytes can explain.
Picture decode_picture(std::string_view bytes);

} // namespace glcast
