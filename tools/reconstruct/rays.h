// The six depth images as the lattice sees them: for each lattice line, where the body starts and ends.
// Unit of length: samples. Sample i of an axis sits at coordinate i, so a ray runs from -1/2 to n - 1/2.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "capture/view_image.h"

namespace glcast {

inline constexpr float no_depth = std::numeric_limits<float>::infinity();

/// The rays along one axis, pixel (u, v) at index v * n + u.
struct AxisRays {
    /// First and last hit as captured, by Side; no_depth (minus) or -no_depth (plus) where nothing was hit.
    std::array<std::vector<float>, 2> depth;
    /// Samples that this axis leaves filled, first > last where none. Gaps are closed here and nowhere else.
    std::vector<std::int16_t> first, last;
    /// 1 where a sheet passes between two samples: first == last is then filled whatever the other axes say.
    std::vector<std::uint8_t> sheet;
    std::vector<std::uint8_t> row_has_sheet; ///< by v
    /// Tangent plane at each hit as a packed outward normal, by Side; 0 where there is none (planes.h).
    std::array<std::vector<std::uint32_t>, 2> plane;
    std::array<const ViewImage*, 2> image{};

    bool hit(std::size_t pixel) const { return depth[0][pixel] < no_depth; }
};

struct Rays {
    int n = 0;
    std::array<AxisRays, 3> axis;

    /// Pixel of the image along `a` that holds sample s.
    std::size_t pixel(int a, const std::array<int, 3>& s) const {
        const ImageAxes image = image_axes(static_cast<Axis>(a));
        return std::size_t(s[image.v]) * n + s[image.u];
    }
    bool inside(const std::array<int, 3>& s) const {
        return s[0] >= 0 && s[1] >= 0 && s[2] >= 0 && s[0] < n && s[1] < n && s[2] < n;
    }
    /// Does the axis alone leave the sample filled? s must be inside.
    bool left_by(int a, const std::array<int, 3>& s) const {
        const std::size_t p = pixel(a, s);
        return axis[a].first[p] <= s[a] && s[a] <= axis[a].last[p];
    }
    /// The whole volume: filled along all three axes, or a sheet's own sample. Any s.
    bool filled(const std::array<int, 3>& s) const;
};

/// Throws std::runtime_error when a view is missing or its size is wrong. `close_gaps`: radius in samples.
Rays make_rays(std::span<const ViewImage> images, double close_gaps);

} // namespace glcast
