#include "shim/preload/seen_through.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "capture/capture_file.h"
#include "shim/preload/scene_thumbnail.h"

namespace glcast::preload {
namespace {

constexpr int picture_size = 192;
constexpr double least_gap = 0.5; ///< samples: a face that is nearer
constexpr long least_pixels = 4;
constexpr double least_depth = 4;   ///< samples: of free space that a place may lie in
constexpr double off_surface = 2.5; ///< samples
constexpr int blocks = 5;           ///< along each side of the picture; one place in each
static_assert(blocks * blocks <= most_seen_places);

/// From a pixel and its depth to the capture frame.
class Unproject {
  public:
    Unproject(const Group& group, const EngineOptions& engine, const DepthPicture& of)
        : to_capture(engine.eye_to_capture * glm::inverse(group.projections.front())), picture(of) {}
    glm::dvec3 operator()(int x, int y, double depth) const {
        const glm::dvec4 clip(2 * (x + 0.5) / picture.width - 1, 2 * (y + 0.5) / picture.height - 1,
                              2 * depth - 1, 1);
        const glm::dvec4 p = to_capture * clip;
        return glm::dvec3(p) / p.w;
    }

  private:
    const glm::dmat4 to_capture;
    const DepthPicture& picture;
};

} // namespace

bool may_see_through(const Scene& scene, int index) {
    const Group& group = scene.groups[index];
    if (group.projections.size() != 1 || group.depth_reversed || !group.writes_depth) return false;
    bool culls = false;
    for (const Draw& draw : scene.draws) {
        if (draw.group != index || !is_solid(draw, group, true)) continue;
        if (draw.eye_map >= 0) return false;
        culls |= draw.shown != Draw::Shown::both;
    }
    return culls;
}

bool shows_both_turns(const Scene& scene, int index) {
    const auto shows = [&](Draw::Shown shown) {
        return std::any_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& draw) {
            return draw.group == index && draw.shown == shown && is_solid(draw, scene.groups[index], true);
        });
    };
    return shows(Draw::Shown::counter_clockwise) && shows(Draw::Shown::clockwise);
}

SeenThrough see_through(const GlTable& gl, const DrawFunction& draw, const Group& group,
                        const EngineOptions& engine) {
    const DepthPicture shown = draw_depths(gl, draw, group.viewport, true, picture_size),
                       all = draw_depths(gl, draw, group.viewport, false, picture_size);
    const Unproject place(group, engine, shown);
    const double sample = engine.box->size / engine.n;
    SeenThrough seen;
    long pixels = 0;
    struct Best {
        double gap = 0;
        glm::dvec3 place{0};
    } best[blocks][blocks];
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x) {
            const float behind = shown.at(x, y), front = all.at(x, y);
            if (!(front < behind)) continue;
            const bool is_background = behind >= 1;
            const glm::dvec3 culled = place(x, y, front), seen_there = place(x, y, behind);
            const double gap = is_background ? engine.n : glm::distance(culled, seen_there) / sample;
            pixels += gap > least_gap;
            Best& here = best[y * blocks / shown.height][x * blocks / shown.width];
            if (is_background || !(gap > std::max(here.gap, least_depth))) continue;
            here.gap = gap;
            here.place = seen_there + (culled - seen_there) * (off_surface / gap);
        }
    seen.any = pixels >= least_pixels;
    for (const auto& row : best)
        for (const Best& each : row)
            if (seen.any && each.gap > 0) seen.places.push_back(each.place);
    return seen;
}

} // namespace glcast::preload
