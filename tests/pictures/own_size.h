// The default levels, each drawn as large as it is made for.
#pragma once
#include <span>
#include <vector>

#include "tests/pictures/reference.h"

namespace glcast::pictures {

struct OwnSize {
    int pixels = 0;       ///< width and height of the picture: what the level is for
    Likeness level, full; ///< antialiased: of the level, and of the full surface drawn as large
    double psnr_outline = 0, psnr_filling = 0; ///< of the level, as in PictureError
};

inline constexpr double good_picture = 40; ///< dB
inline constexpr double hardly_worse = 1;  ///< dB, than the full surface

/// Level::pixels of each level must divide the width of the views. Throws std::invalid_argument where it does
/// not.
std::vector<OwnSize> own_sizes(std::span<const Level> levels, const Level& full,
                               std::span<const ReferenceView> views);

/// As good as anybody can see: 40 dB, or within 1 dB of the full surface where that has less. The finest
/// level is within 1 dB of it in any case.
bool looks_right(const OwnSize& size, bool finest);

} // namespace glcast::pictures
