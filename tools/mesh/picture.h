// A picture in memory.
#pragma once
#include <cstdint>
#include <vector>

namespace glcast {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; ///< row 0 on top
};

} // namespace glcast
