#include "shim/preload/frame_replay.h"

#include <memory>

#include "shim/preload/mask.h"
#include "shim/preload/real.h"
#include "shim/preload/status.h"

namespace glcast::preload {

FrameReplay::FrameReplay(const std::vector<FramePart>& of, const Options& with, Patience& bounds,
                         bool at_rest)
    : gl(masked_table(real_table(), with.mask)), patience(bounds), parts(of), options(with),
      siblings(*of.front().context, at_rest) {}

bool FrameReplay::can_draw() {
    siblings.enter(parts.front());
    return can_make_target(gl);
}

void FrameReplay::analyse() {
    for (const FramePart& part : parts) {
        if (options.prepare_replay) record::prepare(*part.frame);
        siblings.enter(part);
        scenes.push_back(preload::analyse(*part.frame, gl, options.view_angle));
    }
}

std::vector<Candidate> FrameReplay::candidates() const {
    return merge(scenes, [&](int a, int b) {
        return record::share_objects(*parts[a].context->shadow, *parts[b].context->shadow);
    });
}

void FrameReplay::enter_for(const Candidate& candidate) {
    for (std::size_t part = 0; part < parts.size(); ++part)
        if (candidate.in_part[part] >= 0) return siblings.enter(parts[part]);
}

std::vector<ScenePart> FrameReplay::parts_of(const Candidate& candidate) {
    std::vector<ScenePart> of;
    for (std::size_t part = 0; part < parts.size(); ++part)
        if (candidate.in_part[part] >= 0)
            of.push_back({*parts[part].frame, scenes[part], candidate.in_part[part]});
    return of;
}

DrawFunction FrameReplay::drawing(const Candidate& candidate, const Wanted& wanted) const {
    const auto places = std::make_shared<std::vector<DrawPlaces>>(parts.size());
    return [this, &candidate, wanted, places](const GlTable& table, const Sought& sought) {
        has_drawn = true;
        if (!sought.only_places) patience.render_begins();
        for (std::size_t part = 0; part < parts.size(); ++part)
            if (candidate.in_part[part] >= 0)
                replay_group(*parts[part].frame, scenes[part], candidate.in_part[part], wanted, table, sought,
                             &(*places)[part]);
    };
}

std::map<std::string, long> FrameReplay::not_understood(const Candidate& candidate) const {
    std::map<std::string, long> all;
    for (std::size_t part = 0; part < parts.size(); ++part)
        if (candidate.in_part[part] >= 0)
            for (const auto& [what, times] : record::not_understood(*parts[part].frame)) all[what] += times;
    return all;
}

void FrameReplay::end(bool found_nothing) noexcept {
    const bool has_only_looked = found_nothing && !has_drawn;
    try {
        for (const FramePart& part : parts) {
            const bool has_copies = record::has_copies(*part.frame);
            if (has_copies || has_only_looked) siblings.enter(part);
            if (has_copies) record::delete_copies(*part.frame, gl);
            if (has_only_looked) record::let_go(*part.frame, gl);
        }
        if (has_only_looked) siblings.keep();
    } catch (const std::exception&) {
        say_once("copies of textures could not be deleted");
    }
}

} // namespace glcast::preload
