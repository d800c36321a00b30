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

/// A sheet passes between two samples (then first == last, one of these), or a thin wall runs just before the
/// first or after the last sample.
enum Keep : std::uint8_t { keep_between = 1, keep_first = 2, keep_last = 4 };

/// The rays along one axis, pixel (u, v) at index v * n + u.
struct AxisRays {
    /// First and last hit as captured, by Side; no_depth (minus) or -no_depth (plus) where nothing was hit.
    std::array<std::vector<float>, 2> depth;
    /// Samples that this axis leaves filled, first > last where none. Gaps are closed here and nowhere else.
    std::vector<std::int16_t> first, last;
    /// Samples that stay filled whatever the other axes say, because a sheet passes there: bits of Keep.
    std::vector<std::uint8_t> keep;
    std::vector<std::uint8_t> row_keeps; ///< by v: does any pixel of the row
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
    /// Does the axis keep the sample against all others? s must be inside.
    bool kept_by(int a, const std::array<int, 3>& s) const {
        const std::size_t p = pixel(a, s);
        const std::uint8_t keep = axis[a].keep[p];
        return keep && ((s[a] == axis[a].first[p] && (keep & (keep_between | keep_first))) ||
                        (s[a] == axis[a].last[p] && (keep & (keep_between | keep_last))));
    }
    bool left_by_all(const std::array<int, 3>& s) const {
        return left_by(0, s) && left_by(1, s) && left_by(2, s);
    }
    /// The whole volume: filled along all three axes, or a sheet's own sample. Any s.
    bool filled(const std::array<int, 3>& s) const;
};

/// Throws std::runtime_error when a view is missing or its size is wrong. `close_gaps`: radius in samples.
Rays make_rays(std::span<const ViewImage> images, double close_gaps);

} // namespace glcast
