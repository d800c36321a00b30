// Other people's simplification as a viewer would show it: with normals and colours, split at creases.
#pragma once
#include <string>
#include <vector>

#include "tools/mesh/level.h"

namespace glcast::pictures {

struct ShownPeer {
    std::string name;
    /// About so many triangles of the surface, which has normals; colours where it has some. Throws
    /// std::runtime_error where the peer's program fails.
    Level (*run)(const Level& surface, std::size_t triangles);
};

/// The strongest that run: meshoptimizer of npm, collapses with attributes of weight .1, without and with
/// update of what is left; CGAL by Garland and Heckbert, and by Lindstrom and Turk; Blender's collapse;
/// OpenMesh. Those that know positions alone get normals and colours of the nearest point of the surface that
/// faces as they do. Where triangles meet at more than 35 degrees normals are split, for the peers to begin
/// with too.
const std::vector<ShownPeer>& shown_peers();

/// The same surface with a normal for each side of a crease: the triangles of a vertex fall into groups that
/// meet at less than 35 degrees, and each keeps the vertex's normal if that is within 35 degrees of its own.
Level split_at_creases(const Level& surface);

} // namespace glcast::pictures
