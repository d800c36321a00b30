#include "shim/preload/masked_faces.h"

#include <vector>

#include "shim/preload/scene_thumbnail.h"

namespace glcast::preload {
namespace {

constexpr int picture_size = 192;
constexpr long least_pixels = 4;

DepthPicture nearest_depths(const GlTable& gl, std::span<const ScenePart> parts, const Group& group,
                            bool with_masked) {
    const auto draw = [&](const GlTable& table, const Sought&) {
        for (const ScenePart& part : parts) {
            std::vector<std::uint8_t> only;
            for (const Draw& each : part.scene.draws) only.push_back(with_masked || !each.hides);
            replay_group(part.frame, part.scene, part.group, {.only = &only}, table);
        }
    };
    return draw_depths(gl, draw, group.viewport, true, picture_size, PictureDepths::nearest);
}

} // namespace

long masked_beside(const GlTable& gl, std::span<const ScenePart> parts, const Group& group) {
    const bool has_both = group.hidden_triangles > 0 && group.open_triangles[0] + group.open_triangles[1] > 0;
    if (!has_both || group.depth_reversed) return 0;
    const DepthPicture coloured = nearest_depths(gl, parts, group, false),
                       all = nearest_depths(gl, parts, group, true);
    long nearer = 0;
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x) nearer += all.at(x, y) < coloured.at(x, y);
    return nearer >= least_pixels ? group.hidden_triangles : 0;
}

} // namespace glcast::preload
