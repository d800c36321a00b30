#include "shim/preload/cast.h"

#include <stdexcept>

#include "shim/preload/capture_job.h"
#include "shim/preload/capture_plan.h"
#include "shim/preload/contact_sheet.h"
#include "shim/preload/frame_replay.h"
#include "shim/preload/scene_chooser.h"
#include "shim/preload/status.h"

namespace glcast::preload {
namespace {

/// glcast-run says itself what is told.
PatienceLines patience_lines() {
    return {.slow =
                [](const std::string& text) {
                    tell("slow", text);
                    if (!has_status_file()) say("%s", text.c_str());
                },
            .progress = [](const std::string& text) { tell("progress", text); }};
}

CastResult nothing_solid(Census held) { return {CastOutcome::nothing_solid, "", std::move(held)}; }

CastResult list_groups(SceneChooser& chooser, long number, const Options& options, const CastWindow& window,
                       std::vector<Candidate>& listed) {
    chooser.tell_groups(window.name);
    if (!options.list_picture.empty()) {
        listed.insert(listed.end(), chooser.groups().begin(), chooser.groups().end());
        const std::string trouble = write_contact_sheet(listed, options.list_picture);
        if (!trouble.empty()) return failure(trouble);
    }
    tell("listed", std::to_string(number));
    return {CastOutcome::listed,
            "listed frame " + std::to_string(number),
            {},
            chooser.rating(chooser.groups().front())};
}

CastResult cast(FrameReplay& replay, const SceneChooser& chooser, const Candidate& chosen, long number,
                const Options& options, const CastWindow& window) {
    CapturePlan plan(replay, options, chosen);
    if (plan.has_box()) return CaptureJob(replay, options, window, number, plan).run();
    if (!replay.patience.over().empty()) return failure(replay.patience.over());
    Census held = chooser.held();
    if (plan.would_show_blended()) held.see_through = held.solid;
    return nothing_solid(std::move(held));
}

CastResult look_and_cast(FrameReplay& replay, long number, const Options& options, const CastWindow& window,
                         std::vector<Candidate>& listed) {
    if (!replay.can_draw()) return failure("this OpenGL has no framebuffer objects to draw into");
    SceneChooser chooser(replay, options);
    if (chooser.is_empty() || (!chooser.has_scene() && options.group == 0))
        return nothing_solid(chooser.held());
    if (options.list) return list_groups(chooser, number, options, window, listed);
    const Candidate* const chosen = chooser.chosen();
    if (!chosen)
        return chooser.has_scene() ? failure(chooser.groups_instead()) : nothing_solid(chooser.held());
    const Rating rating = chooser.rating(*chosen);
    if (window.to_beat && !better(rating, *window.to_beat)) return {CastOutcome::not_better, "", {}, rating};
    CastResult result = cast(replay, chooser, *chosen, number, options, window);
    if (result.outcome == CastOutcome::captured) result.rating = rating;
    return result;
}

} // namespace

CastResult cast_frame(const std::vector<FramePart>& parts, long number, const Options& options,
                      const CastWindow& window, std::vector<Candidate>& listed) {
    CastResult result;
    try {
        Patience patience(options.most_seconds, patience_lines());
        FrameReplay replay(parts, options, patience, window.at_rest);
        try {
            result = look_and_cast(replay, number, options, window, listed);
        } catch (const std::exception& error) {
            result = failure(error.what());
        }
        replay.end(result.outcome == CastOutcome::nothing_solid);
    } catch (const std::exception& error) {
        result = failure(error.what());
    }
    return result;
}

} // namespace glcast::preload
