// What the rays of one axis hit: for each pixel, every surface from the smallest depth to the largest, with
// colour and normal. Sparse: background costs four bytes a pixel, a hit sixteen.
// Unit of length: samples. Sample i of an axis sits at coordinate i, so a ray runs from -1/2 to n - 1/2.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "capture/view_image.h"

namespace glcast {

inline constexpr float no_depth = std::numeric_limits<float>::infinity();

/// Pixel (u, v) is index v * n + u; its hits are start[pixel] .. start[pixel + 1], ordered by depth.
struct AxisHits {
    std::vector<std::uint32_t> start;
    std::vector<float> depth;
    std::vector<std::uint32_t> plane;  ///< tangent plane, packed normal of unknown sign; 0 none (planes.h)
    std::vector<std::uint32_t> normal; ///< as drawn, packed; 0 none
    std::vector<std::uint32_t> colour; ///< as drawn, pack_colour; the top two bits: sides.h

    /// In captures of both sides `normal` and `colour` are what a viewer on the minus side sees, and these
    /// are a viewer's on the plus side. Else empty: both see the same.
    std::vector<std::uint32_t> plus_normal, plus_colour;

    /// To a viewer on `side` (1: plus).
    std::uint32_t colour_to(int side, std::uint32_t hit) const {
        return side == 1 && !plus_colour.empty() ? plus_colour[hit] : colour[hit];
    }
    std::uint32_t normal_to(int side, std::uint32_t hit) const {
        return side == 1 && !plus_normal.empty() ? plus_normal[hit] : normal[hit];
    }

    bool hit(std::size_t pixel) const { return start[pixel] != start[pixel + 1]; }
    /// First and last depth; no_depth and -no_depth where nothing was hit.
    float front(std::size_t pixel) const { return hit(pixel) ? depth[start[pixel]] : no_depth; }
    float back(std::size_t pixel) const { return hit(pixel) ? depth[start[pixel + 1] - 1] : -no_depth; }
};

inline constexpr std::uint32_t no_hit = ~0u;

/// Pixel of the n x n image along axis `a` that holds sample s.
inline std::size_t pixel_of(int a, const std::array<int, 3>& s, int n) {
    const ImageAxes image = image_axes(static_cast<Axis>(a));
    return std::size_t(s[image.v]) * n + s[image.u];
}

/// Unit vector in 32 bits (octahedral, 3e-5 radians); never 0.
std::uint32_t pack_normal(const glm::vec3& unit);
inline glm::vec3 unpack_normal(std::uint32_t packed) {
    const float a = (float(std::int32_t(packed >> 16)) - 32768) / 32767,
                b = (float(std::int32_t(packed & 0xffff)) - 32768) / 32767;
    const float z = 1 - std::abs(a) - std::abs(b); // both ways, so that nothing branches
    const float folded_a = std::copysign(1 - std::abs(b), a), folded_b = std::copysign(1 - std::abs(a), b);
    return glm::normalize(glm::vec3(z < 0 ? folded_a : a, z < 0 ? folded_b : b, z));
}
/// 0..1 with ten bits a channel: every 8-bit colour comes back as it was.
std::uint32_t pack_colour(const glm::vec3& colour);
/// Of the 1024 values of a channel.
inline constexpr auto unpacked_channel = [] {
    std::array<float, 1024> values{};
    for (int c = 0; c < 1024; ++c) values[std::size_t(c)] = float(c) / 1020;
    return values;
}();
inline glm::vec3 unpack_colour(std::uint32_t packed) {
    return {unpacked_channel[packed >> 20 & 1023], unpacked_channel[packed >> 10 & 1023],
            unpacked_channel[packed & 1023]};
}

/// Takes the images of a capture one at a time, in any order, so that they need not be in memory together.
class HitBuilder {
  public:
    /// Throws std::runtime_error when the image's size is wrong or not that of the others, or when its view
    /// was there before.
    void add(const ViewImage& image);
    /// Throws std::runtime_error when one of the six outer views is missing. Leaves the builder empty.
    std::array<AxisHits, 3> finish();
    int resolution() const { return n; }       ///< 0 before the first image
    bool has_layers() const { return layers; } ///< an image of what lies behind the first hit was given

  private:
    struct Layer {
        View view;
        std::vector<std::uint32_t> pixel, normal, colour, other_normal, other_colour;
        std::vector<float> depth;
    };
    AxisHits merge(int axis);
    int n = 0;
    bool layers = false, both_sides = false;
    std::vector<Layer> added;
};

} // namespace glcast
