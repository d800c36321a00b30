#include "shim/preload/left_out.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "shim/preload/backdrop.h"
#include "shim/preload/outline.h"

namespace glcast::preload {
namespace {

/// Backdrops are plain; what has an outline need not be.
constexpr long most_triangles = 100'000, most_outlined_triangles = 1'000'000;
constexpr double much_of_the_window = 0.5;
constexpr double beyond_the_window = 3; ///< wide; the window is 2 wide, and boxes are cubes seen askew

struct Counts {
    long triangles = 0, draws = 0;
    void add(const Draw& draw) { triangles += draw.triangles, ++draws; }
    std::string text() const {
        const auto count = [](long number, const char* what) {
            return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
        };
        return count(triangles, "triangle") + " in " + count(draws, "draw");
    }
};

const Group& group_of(const ScenePart& part) { return part.scene.groups[part.group]; }

bool reaches_beyond_the_window(const Group& group, const EngineOptions& engine) {
    if (group.projections.empty()) return false;
    const glm::dmat4 to_clip = group.projections.front() * glm::inverse(engine.eye_to_capture);
    glm::dvec2 lo(INFINITY), hi(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 on(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec4 clip = to_clip * glm::dvec4(engine.box->lo + on * engine.box->size, 1);
        if (!(clip.w > 0)) return true;
        lo = glm::min(lo, glm::dvec2(clip) / clip.w), hi = glm::max(hi, glm::dvec2(clip) / clip.w);
    }
    return std::max(hi.x - lo.x, hi.y - lo.y) > beyond_the_window;
}

/// Is a polygon that is counter-clockwise in the window seen from the side to which its normal points, by the
/// right hand?
bool keeps_hands(const Group& group, const EngineOptions& engine) {
    const bool turned = glm::determinant(glm::dmat3(engine.eye_to_capture)) < 0;
    return group.is_mirrored() == turned;
}

Counts drawn_first(std::span<const ScenePart> parts) {
    Counts counts;
    for (const ScenePart& part : parts)
        for (const Draw& draw : part.scene.draws)
            if (draw.group == part.group && !draw.left_out && !is_solid(draw, group_of(part), false) &&
                is_solid(draw, group_of(part), true))
                counts.add(draw);
    return counts;
}

class Finder {
  public:
    Finder(std::span<const ScenePart> of, const GlTable& gl, const EngineOptions& options, MayHave what)
        : parts(of), engine(options), may_have(what),
          scene(parts, gl, engine, may_have.outlines ? most_outlined_triangles : most_triangles) {}

    LeftOut run() {
        const std::size_t plain = scene.shapes.size();
        if ((may_have.backdrops || may_have.outlines) && plain > 0 && (plain > 1 || scene.has_others()))
            find();
        return {around.draws + pinned.draws + outlines.draws, lines()};
    }

  private:
    void find() {
        scene.read();
        const auto eye = eye_of(group_of(parts[0]), engine.eye_to_capture);
        if (!eye) return;
        if (may_have.outlines)
            mark(find_outlines(scene.shapes, *eye, keeps_hands(group_of(parts[0]), engine)), outlines);
        if (!may_have.backdrops) return;
        for (std::size_t i = 0; i < scene.shapes.size(); ++i)
            if (scene.draw(i).left_out) scene.shapes[i] = {};
        const Backdrops found = find_backdrops(scene.shapes, *eye, [&] { return scene.bounds_of_others(); });
        times = found.times_as_wide;
        mark(found.is_backdrop, around);
    }

    void mark(const std::vector<bool>& found, Counts& counts) {
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (!found[i]) continue;
            scene.draw(i).left_out = true;
            (scene.shapes[i].pinned ? pinned : counts).add(scene.draw(i));
        }
    }

    std::string lines() const {
        std::string backdrops;
        const auto tell = [&](const Counts& counts, const std::string& why) {
            if (counts.draws > 0)
                backdrops += (backdrops.empty() ? "" : ", ") + counts.text() + " (" + why + ")";
        };
        char factor[64];
        std::snprintf(factor, sizeof factor, "%.3g times as wide as all else", times);
        tell(around, factor);
        tell(pinned, "at the far plane by the depth range");
        tell(drawn_first(parts), "drawn first, without depth");
        std::string all;
        if (!backdrops.empty()) all = "left out as a backdrop: " + backdrops;
        if (outlines.draws > 0)
            all += (all.empty() ? "left out" : "; and") + std::string(" as an outline: ") + outlines.text() +
                   " (a hull close around other things, of which only the far side is drawn)";
        return all.empty() ? all : all + "; --backdrop keep casts it";
    }

    const std::span<const ScenePart> parts;
    const EngineOptions& engine;
    const MayHave may_have;
    SceneShapes scene;
    double times = 0;
    Counts around, pinned, outlines;
};

} // namespace

bool may_have_backdrops(std::span<const ScenePart> parts, const EngineOptions& engine, double coverage) {
    const auto has_pinned = [](const ScenePart& part) {
        return std::any_of(part.scene.draws.begin(), part.scene.draws.end(),
                           [&](const Draw& draw) { return draw.group == part.group && draw.pinned; });
    };
    return coverage >= much_of_the_window || reaches_beyond_the_window(group_of(parts[0]), engine) ||
           std::any_of(parts.begin(), parts.end(), has_pinned);
}

LeftOut leave_out(std::span<const ScenePart> parts, const GlTable& gl, const EngineOptions& engine,
                  MayHave may_have) {
    return Finder(parts, gl, engine, may_have).run();
}

} // namespace glcast::preload
