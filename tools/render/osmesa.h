// OSMesa, loaded when it is first needed: the commands that draw nothing neither load nor need it. Internal.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast {

/// A square to draw in, current on this thread for as long as it lives.
class Osmesa {
  public:
    explicit Osmesa(
        int size); ///< pixels; throws std::runtime_error where there is no OSMesa, or not so large
    ~Osmesa();

    const GlTable& gl() const { return table; }
    const std::vector<std::uint8_t>& finish(); ///< RGBA, row 0 at the bottom
    static int largest();                      ///< the largest size it takes

  private:
    GlTable table{};
    void* context = nullptr;
    std::vector<std::uint8_t> pixels;
};

} // namespace glcast
