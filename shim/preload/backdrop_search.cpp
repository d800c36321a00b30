#include "shim/preload/backdrop_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "shim/preload/backdrop.h"
#include "shim/preload/feedback_pass.h"

namespace glcast::preload {
namespace {

/// Backdrops are plain: draws are looked at while there are no more triangles in all.
constexpr long most_triangles = 100'000;
constexpr int vertex_floats = 3; // GL_3D
constexpr double much_of_the_window = 0.5;
constexpr double beyond_the_window = 3; ///< wide; the window is 2 wide, and boxes are cubes seen askew

const char* plural(long count) { return count == 1 ? "" : "s"; }

std::string count_of(long triangles, long draws) {
    return std::to_string(triangles) + " triangle" + plural(triangles) + " in " + std::to_string(draws) +
           " draw" + plural(draws);
}

struct Counts {
    long triangles = 0, draws = 0;
    void add(const Draw& draw) { triangles += draw.triangles, ++draws; }
    std::string text() const { return count_of(triangles, draws); }
};

class Search {
  public:
    Search(std::span<const ScenePart> of, const GlTable& table, const EngineOptions& options)
        : parts(of), gl(table), engine(options) {}

    LeftOut run(double coverage) {
        choose();
        const bool may_be = pinned_ones() || coverage >= much_of_the_window || reaches_beyond_the_window();
        if (may_be && shapes.size() > 0 && shapes.size() + rich > 1) measure();
        return {around.draws + pinned.draws, text()};
    }

  private:
    struct Place {
        std::size_t part, draw;
    };
    Draw& at(const Place& place) const { return parts[place.part].scene.draws[place.draw]; }

    /// The solid draws, those with fewest triangles first; in the order of the frame.
    void choose() {
        std::size_t kept = 0;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            const Scene& scene = parts[part].scene;
            for (std::size_t i = 0; i < scene.draws.size(); ++i)
                if (scene.draws[i].group == parts[part].group &&
                    is_solid(scene.draws[i], scene.groups[parts[part].group], false)) {
                    if (scene.draws[i].stencil.is_kept)
                        ++kept; // wherever its corners are
                    else
                        places.push_back({part, i});
                }
        }
        std::vector<std::size_t> order(places.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](auto a, auto b) { return at(places[a]).triangles < at(places[b]).triangles; });
        std::vector<bool> is_plain(places.size());
        long sum = 0;
        for (const std::size_t i : order)
            if ((sum += at(places[i]).triangles) <= most_triangles) is_plain[i] = true;
        for (const ScenePart& part : parts) masks.emplace_back(part.scene.draws.size(), 0);
        std::vector<Place> plain;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!is_plain[i]) continue;
            masks[places[i].part][places[i].draw] = 1;
            plain.push_back(places[i]);
        }
        rich = kept + places.size() - plain.size();
        places = std::move(plain);
        for (const Place& place : places) {
            const Draw& draw = at(place);
            shapes.push_back({{}, draw.textured, draw.lit, draw.pinned});
        }
    }

    bool pinned_ones() const {
        return std::any_of(shapes.begin(), shapes.end(), [](const DrawShape& shape) { return shape.pinned; });
    }

    bool reaches_beyond_the_window() const {
        const Group& group = parts[0].scene.groups[parts[0].group];
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

    void measure() {
        for (std::size_t part = 0; part < parts.size(); ++part) read_shapes(part);
        const auto eye = eye_of(parts[0].scene.groups[parts[0].group], engine.eye_to_capture);
        if (!eye) return;
        const Backdrops found = find_backdrops(shapes, *eye, [&] { return bounds_of_rich(); });
        times = found.times_as_wide;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!found.is_backdrop[i]) continue;
            at(places[i]).backdrop = true;
            (shapes[i].pinned ? pinned : around).add(at(places[i]));
        }
    }

    void read_shapes(std::size_t part) {
        const ScenePart& of = parts[part];
        const Wanted wanted{.marks = true, .only = &masks[part]};
        const std::vector<GLfloat> values = feed_back(
            gl, [&](const GlTable& table) { replay_group(of.frame, of.scene, of.group, wanted, table); },
            engine, GL_3D);
        std::vector<std::size_t> shape_of(of.scene.draws.size(), shapes.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i].part == part) shape_of[places[i].draw] = i;
        const FeedbackLattice lattice(*engine.box);
        std::size_t shape = shapes.size();
        for (const GLfloat *v = values.data(), *end = v + values.size(); v < end;) {
            const auto token = static_cast<GLenum>(*v++);
            if (token == GL_PASS_THROUGH_TOKEN) {
                const auto draw = static_cast<std::size_t>(-1 - *v++);
                if (draw < shape_of.size()) shape = shape_of[draw];
            } else if (token == GL_POLYGON_TOKEN) {
                const auto corners = static_cast<std::size_t>(*v++);
                std::vector<glm::dvec3> polygon;
                for (std::size_t i = 0; i < corners; ++i)
                    polygon.push_back(lattice.point(v + i * vertex_floats));
                v += corners * vertex_floats;
                if (shape < shapes.size()) shapes[shape].polygons.push_back(std::move(polygon));
            } else {
                v += (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN ? 2 : 1) * vertex_floats;
            }
        }
    }

    /// By drawing them.
    Bounds bounds_of_rich() const {
        Bounds bounds;
        if (rich == 0) return bounds;
        std::vector<std::vector<std::uint8_t>> others = masks;
        for (auto& mask : others)
            for (auto& bit : mask) bit = !bit;
        EngineOptions options = engine;
        options.search = *engine.box;
        const auto box = find_box(
            gl,
            [&](const GlTable& table) {
                for (std::size_t part = 0; part < parts.size(); ++part)
                    replay_group(parts[part].frame, parts[part].scene, parts[part].group,
                                 {.only = &others[part], .stencil = engine.stencil}, table);
            },
            options);
        if (box) bounds.add(box->lo), bounds.add(box->lo + box->size);
        return bounds;
    }

    std::string text() const {
        Counts first;
        for (const ScenePart& part : parts)
            for (const Draw& draw : part.scene.draws) {
                const Group& group = part.scene.groups[part.group];
                if (draw.group == part.group && !is_solid(draw, group, false) && is_solid(draw, group, true))
                    if (!draw.backdrop) first.add(draw);
            }
        std::string all;
        const auto tell = [&](const Counts& counts, const std::string& why) {
            if (counts.draws > 0) all += (all.empty() ? "" : ", ") + counts.text() + " (" + why + ")";
        };
        char factor[64];
        std::snprintf(factor, sizeof factor, "%.3g times as wide as all else", times);
        tell(around, factor);
        tell(pinned, "at the far plane by the depth range");
        tell(first, "drawn first, without depth");
        return all.empty() ? all : "left out as a backdrop: " + all + "; --backdrop keep casts it";
    }

    const std::span<const ScenePart> parts;
    const GlTable& gl;
    const EngineOptions& engine;
    std::vector<Place> places; ///< of the shapes
    std::vector<DrawShape> shapes;
    std::size_t rich = 0;                         ///< draws that are not looked at
    std::vector<std::vector<std::uint8_t>> masks; ///< of each part's draws: is it looked at?
    double times = 0;
    Counts around, pinned;
};

} // namespace

LeftOut leave_out_backdrops(std::span<const ScenePart> parts, const GlTable& gl, const EngineOptions& engine,
                            double coverage) {
    return Search(parts, gl, engine).run(coverage);
}

} // namespace glcast::preload
