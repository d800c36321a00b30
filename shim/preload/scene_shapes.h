// The shapes of the draws of a recorded frame's scene, asked of GL by feedback.
#pragma once
#include <span>
#include <vector>

#include "capture/engine.h"
#include "shim/preload/draw_shape.h"
#include "shim/preload/scene.h"

namespace glcast::preload {

/// What one part of a frame draws of the scene.
struct ScenePart {
    const record::Frame& frame;
    Scene& scene;
    int group; ///< index into the scene's groups
};

class SceneShapes {
  public:
    /// Chooses among the solid draws: those with fewest triangles, while there are no more than
    /// `most_triangles` in all. `engine.box`: around what is drawn.
    SceneShapes(std::span<const ScenePart> parts, const GlTable& gl, const EngineOptions& engine,
                long most_triangles);
    /// Asks GL for their polygons, inside the box. In the current context.
    void read();

    std::vector<DrawShape> shapes; ///< in the order of the frame
    Draw& draw(std::size_t shape) const { return draw_at(places[shape]); }
    bool has_others() const { return others > 0; }
    /// Of the draws that were not chosen, by drawing them.
    Bounds bounds_of_others() const;

  private:
    struct Place {
        std::size_t part, draw;
    };
    Draw& draw_at(const Place& place) const { return parts[place.part].scene.draws[place.draw]; }
    void read_part(std::size_t part);

    const std::span<const ScenePart> parts;
    const GlTable& gl;
    const EngineOptions& engine;
    std::vector<Place> places; ///< of the shapes
    std::size_t others = 0;
    std::vector<std::vector<std::uint8_t>> masks; ///< of each part's draws: is it chosen?
};

} // namespace glcast::preload
