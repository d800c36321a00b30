#include <cstdio>

#include "tools/render/render.h"

namespace glcast {
namespace {

std::string said(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Distances in samples where the sample is known.
std::string distances(const LevelError& error, double sample) {
    const double unit = sample > 0 ? sample : 1;
    std::string text = said(", error mean %.3g", error.mean / unit);
    if (error.p999 > 0) text += said(", 99.9 %% %.3g", error.p999 / unit);
    return text + said(", max %.3g", error.max / unit) + (sample > 0 ? " samples" : "");
}

} // namespace

std::string level_caption(const Level& level) {
    const std::size_t triangles = level.mesh.triangles.size();
    std::string text = level.name + (level.name.empty() ? "" : ": ") + std::to_string(triangles) +
                       (triangles == 1 ? " triangle" : " triangles");
    const Picture& colour = level.texture.colour;
    if (!level.texture.empty())
        text += ", texture " + std::to_string(colour.width) + " x " + std::to_string(colour.height);
    const LevelError& error = level.error;
    if (error.max > 0) text += distances(error, level.sample);
    if (error.normal_mean_degrees > 0) text += said(", normals %.2g degrees", error.normal_mean_degrees);
    if (error.colour_p999 > 0)
        text += said(", colours %.2g", error.colour_mean) + said(" (99.9 %% %.2g)", error.colour_p999);
    if (error.unsupported_area_share > 0)
        text += said(", %.2g %% unseen", 100 * error.unsupported_area_share);
    return text;
}

} // namespace glcast
