#include "shim/preload/sight.h"

#include <algorithm>

namespace glcast::preload {
namespace {

constexpr std::size_t most_known = 32;

} // namespace

glm::dmat4 EyeMap::apply(const glm::dmat4& modelview) const {
    glm::dmat4 mapped = rows * modelview;
    mapped[3] += origin;
    return mapped;
}

bool is_perspective(const glm::dmat4& p) { return p[0][3] != 0 || p[1][3] != 0 || p[2][3] != 0; }

const Sight& Sights::look(const glm::dmat4& projection, const glm::dmat4& modelview,
                          const std::array<GLint, 4>& viewport) {
    const bool in_modelview = is_projective(modelview) && !is_perspective(projection);
    if (last && !in_modelview && !last->in_modelview && last->projection == projection &&
        last_viewport == viewport)
        return *last;
    Sight sight;
    sight.projection = projection;
    sight.in_modelview = in_modelview;
    const glm::dmat4 whole = in_modelview ? projection * modelview : projection;
    sight.perspective = is_perspective(whole);
    sight.camera = camera_of(whole, viewport);
    sight.depth = find_depth_line(whole);
    if (in_modelview && sight.camera) {
        sight.camera->to_eye = glm::dmat4(1.0);
        sight.camera->plain = false;
    }
    last_viewport = viewport;
    return last.emplace(sight);
}

std::optional<Camera> Sights::camera_of(const glm::dmat4& to_clip, const std::array<GLint, 4>& viewport) {
    auto camera = find_camera(to_clip);
    if (!is_perspective(to_clip) || (camera && camera->plain)) {
        if (camera && camera->lens.perspective) remember(camera->lens, to_clip);
        return camera;
    }
    if (camera && is_square(camera->lens, viewport[2], viewport[3])) {
        remember(camera->lens, to_clip);
        return camera;
    }
    // A model that is scaled unevenly is in the matrix, or pixels are not square.
    const auto line = find_depth_line(to_clip);
    if (const auto lens = line ? lens_with(*line) : std::nullopt) return with_lens(to_clip, *lens);
    const auto stretched = find_camera_of_stretched(to_clip);
    if (stretched && is_square(stretched->lens, viewport[2], viewport[3])) return stretched;
    was_unknown = true;
    return camera;
}

void Sights::remember(const Lens& lens, const glm::dmat4& to_clip) {
    const auto line = find_depth_line(to_clip);
    if (line && known.size() < most_known && !lens_with(*line)) known.push_back({lens, *line});
}

std::optional<Lens> Sights::lens_with(const DepthLine& line) const {
    const auto same = [&](const Known& k) { return same_line(k.depth, line); };
    const auto at = std::find_if(known.begin(), known.end(), same);
    return at == known.end() ? std::nullopt : std::optional(at->lens);
}

} // namespace glcast::preload
