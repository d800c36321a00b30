#include "shim/preload/scene_chooser.h"

#include <algorithm>

#include "shim/preload/status.h"

namespace glcast::preload {

SceneChooser::SceneChooser(FrameReplay& of, const Options& with) : replay(of), options(with) {
    replay.analyse();
    candidates = replay.candidates();
    draw_pictures(candidates, options.include, !options.list_picture.empty(),
                  [&](const Candidate& candidate) { return picture_of(candidate); });
    rank(candidates, options.include);
}

Thumbnail SceneChooser::picture_of(const Candidate& candidate) {
    constexpr int size = 192;
    replay.enter_for(candidate);
    const Wanted wanted{
        .everything = true, .backdrops = options.keep_backdrops, .transparent = options.transparent};
    return draw_thumbnail(replay.gl, replay.drawing(candidate, wanted), candidate.group.viewport,
                          candidate.group.depth_reversed, size);
}

const Candidate* SceneChooser::chosen() const {
    const std::size_t number = options.group > 0 ? static_cast<std::size_t>(options.group) : 1;
    return number <= candidates.size() ? &candidates[number - 1] : nullptr;
}

Rating SceneChooser::rating(const Candidate& candidate) const {
    return {candidate, substance(candidate.group, options.include)};
}

Census SceneChooser::held() const {
    Census held;
    for (const Candidate& c : candidates) {
        (is_scene(c) ? held.solid : held.flat) += c.group.triangles + c.group.outlined;
        if (is_scene(c)) held.masked += c.group.hidden_triangles;
        held.lines += c.group.lines;
        held.points += c.group.points;
    }
    for (const Scene& scene : replay.all_scenes()) held.pixels += scene.pixels;
    for (const FramePart& part : replay.all_parts())
        for (const auto& [what, times] : record::not_understood(*part.frame))
            if (what.starts_with("a draw under")) held.shaders += times;
    if (!candidates.empty() && !chosen()) held.no_such_group = groups_instead();
    return held;
}

std::string SceneChooser::groups_instead() const {
    constexpr std::size_t most = 6;
    const std::size_t count = candidates.size();
    std::string text = "there is no group " + std::to_string(options.group) + ", the frame has " +
                       std::to_string(count) + (count == 1 ? " group" : " groups");
    for (std::size_t i = 0; i < std::min(count, most); ++i)
        text += (i == 0 ? ": " : "; ") + std::to_string(i + 1) + " " + describe(candidates[i].group);
    return text + (count > most ? "; ... (--list shows all)" : "");
}

void SceneChooser::tell_groups(const std::string& window) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        Candidate& c = candidates[i];
        c.number = static_cast<int>(i) + 1;
        c.window = window;
        const std::string text = std::to_string(c.number) + " " + describe(c.group) +
                                 (c.backdrop ? ", a backdrop"
                                  : c.inset  ? ", an inset"
                                             : "") +
                                 (c.window.empty() ? "" : ", " + c.window);
        if (speaks_alone()) say("group %s", text.c_str());
        tell("group", text);
    }
}

} // namespace glcast::preload
