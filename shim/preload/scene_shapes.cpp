#include "shim/preload/scene_shapes.h"

#include <algorithm>

#include "shim/preload/feedback_pass.h"

namespace glcast::preload {
namespace {

constexpr int vertex_floats = 3; // GL_3D

} // namespace

SceneShapes::SceneShapes(std::span<const ScenePart> of, const GlTable& table, const EngineOptions& options,
                         long most_triangles)
    : parts(of), gl(table), engine(options) {
    std::vector<Place> all;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const Scene& scene = parts[part].scene;
        for (std::size_t i = 0; i < scene.draws.size(); ++i)
            if (scene.draws[i].group == parts[part].group &&
                is_solid(scene.draws[i], scene.groups[parts[part].group], false)) {
                if (scene.draws[i].stencil.is_kept)
                    ++others; // wherever its corners are
                else
                    all.push_back({part, i});
            }
        masks.emplace_back(scene.draws.size(), 0);
    }
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return draw_at(all[a]).triangles < draw_at(all[b]).triangles; });
    long sum = 0;
    for (const std::size_t i : order)
        if ((sum += draw_at(all[i]).triangles) <= most_triangles) masks[all[i].part][all[i].draw] = 1;
    for (const Place& place : all) {
        if (!masks[place.part][place.draw]) {
            ++others;
            continue;
        }
        const Draw& draw = draw_at(place);
        places.push_back(place);
        shapes.push_back({{}, draw.textured, draw.lit, draw.pinned, draw.shown});
    }
}

void SceneShapes::read() {
    for (std::size_t part = 0; part < parts.size(); ++part) read_part(part);
}

void SceneShapes::read_part(std::size_t part) {
    const ScenePart& of = parts[part];
    const Wanted wanted{.marks = true, .only = &masks[part]};
    const std::vector<GLfloat> values = feed_back(
        gl, [&](const GlTable& table) { replay_group(of.frame, of.scene, of.group, wanted, table); }, engine,
        GL_3D);
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
            ShapePolygon polygon;
            for (std::size_t i = 0; i < corners; ++i) polygon.push_back(lattice.point(v + i * vertex_floats));
            v += corners * vertex_floats;
            if (shape < shapes.size()) shapes[shape].polygons.push_back(std::move(polygon));
        } else {
            v += (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN ? 2 : 1) * vertex_floats;
        }
    }
}

Bounds SceneShapes::bounds_of_others() const {
    Bounds bounds;
    if (others == 0) return bounds;
    std::vector<std::vector<std::uint8_t>> rest = masks;
    for (auto& mask : rest)
        for (auto& bit : mask) bit = !bit;
    EngineOptions options = engine;
    options.search = *engine.box;
    const DrawFunction draw = [&](const GlTable& table) {
        for (std::size_t part = 0; part < parts.size(); ++part)
            replay_group(parts[part].frame, parts[part].scene, parts[part].group,
                         {.only = &rest[part], .stencil = engine.stencil}, table);
    };
    if (const auto box = find_box(gl, draw, options)) bounds.add(box->lo), bounds.add(box->lo + box->size);
    return bounds;
}

} // namespace glcast::preload
