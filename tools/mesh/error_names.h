// What the measured errors of a level are called in `extras` of glTF and in every --json.
#pragma once
#include "tools/mesh/level.h"

namespace glcast {

struct ErrorName {
    const char* name;
    double LevelError::*value;
};

inline constexpr ErrorName error_names[] = {
    {"meanError", &LevelError::mean},
    {"p999Error", &LevelError::p999},
    {"maxError", &LevelError::max},
    {"normalMeanDegrees", &LevelError::normal_mean_degrees},
    {"colourMean", &LevelError::colour_mean},
    {"colourP999", &LevelError::colour_p999},
    {"unsupportedAreaShare", &LevelError::unsupported_area_share},
    {"disagreeingNormalsShare", &LevelError::disagreeing_normals_share},
};

} // namespace glcast
