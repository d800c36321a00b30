// What the program's own eye sees through faces that it culls: rooms whose near walls are not drawn, the far
// side of hulls.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "capture/engine.h"
#include "shim/preload/scene.h"

namespace glcast::preload {

/// Can it be told? In a group with one projection, nearer depths the lesser ones, of which something is
/// culled.
bool may_see_through(const Scene& scene, int group);

/// Some draws show faces that are counter-clockwise in the window, and some the others: outlines may lie on
/// what they are about, and are not seen then.
bool shows_both_turns(const Scene& scene, int group);

struct SeenThrough {
    bool any = false; ///< culling hides something that the eye would see
    /// Places in the free space before what is seen instead, capture frame, spread over the picture. At most
    /// `most_seen_places`.
    std::vector<glm::dvec3> places;
};

/// `draw` plays what is cast, into two small pictures: with the program's culling, and without any. In the
/// current context.
SeenThrough see_through(const GlTable& gl, const DrawFunction& draw, const Group& group,
                        const EngineOptions& engine);

} // namespace glcast::preload
