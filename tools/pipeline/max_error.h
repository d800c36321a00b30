// --max-error: how coarse may a level be?
#pragma once
#include <string>

#include "tools/mesh/level.h"
#include "tools/simplify/simplify.h"

namespace glcast {

/// "0.5" (samples), "0.5u" (model units), "0.1%" (of the diagonal of the bounding box).
struct ErrorLimit {
    enum class Unit { samples, units, percent } unit = Unit::samples;
    double value = 0;

    std::string text() const;                 ///< as it is written
    double in_units(const Level& full) const; ///< throws std::runtime_error where the sample is not known
};

/// Throws std::runtime_error on what is not a limit.
ErrorLimit parse_error_limit(const std::string& text);

/// The fewest triangles, to about 5 %, of a level whose largest measured distance from the full surface,
/// either way, is within the limit (model units); all of them where none is. By search: levels are made and
/// measured, and errors taken to grow from level to level; the level found has been measured itself.
SimplifyTarget coarsest_within(const Level& full, double limit, const SimplifyOptions& options);

} // namespace glcast
