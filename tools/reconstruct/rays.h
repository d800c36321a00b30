// The captured images as the lattice sees them, and the volume that they leave.
// Unit of length: samples (hits.h).
#pragma once
#include <optional>

#include "tools/reconstruct/hits.h"
#include "tools/reconstruct/volume.h"

namespace glcast {

struct Rays {
    int n = 0;
    std::array<AxisHits, 3> axis;
    Volume volume;                ///< filled samples; a sheet's own among them
    bool complete = false;        ///< every surface along the lattice lines is known
    float half_thickness = 0.05f; ///< of a sheet without thickness, samples

    /// Pixel of the image along `a` that holds sample s.
    std::size_t pixel(int a, const std::array<int, 3>& s) const { return pixel_of(a, s, n); }
    bool inside(const std::array<int, 3>& s) const {
        return s[0] >= 0 && s[1] >= 0 && s[2] >= 0 && s[0] < n && s[1] < n && s[2] < n;
    }
    bool filled(const std::array<int, 3>& s) const { return volume.has(s); }
};

} // namespace glcast
