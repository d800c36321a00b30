// Morton's curve through 1024 cells a side.
#pragma once
#include <cstdint>

namespace glcast {

/// The low 10 bits of x, three apart.
inline std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

} // namespace glcast
