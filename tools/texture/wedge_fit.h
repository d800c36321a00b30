// Normals and colours of a level's corners, fitted to what was captured.
// Wedges: Hoppe 1998, "Efficient implementation of progressive meshes"; least squares over the surface
// instead of the nearest point: Hoppe, DeRose, Duchamp, McDonald and Stuetzle 1993, "Mesh optimization",
// there for places.
#pragma once
#include "tools/mesh/level.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

struct WedgeOptions {
    /// Corners of a vertex are one wedge while what was captured over their triangles agrees to this at the
    /// vertex; flat sides, over each of which the normal is one and the same, to 5 degrees.
    double degrees = 20;
    double colour = 0.15; ///< of a channel, 0..1
    static constexpr double any_colour = 2;
    /// No normal of a corner is further from its triangle's than this: renderers would shade it black, as
    /// their light stops where the triangle turns away. What was drawn inward stays so, as far from the
    /// triangle's back.
    double farthest_degrees = 75;
};

/// Gives a closed level wedges, or its vertices normals and colours where none has two wedges: those for
/// which the level, its corners' values mixed linearly, is least far from the captured surface over its
/// triangles, by area. Where nothing was captured they continue what lies around, or keep the vertices' own.
/// The vertices' normals and colours become those of their largest wedge. The same input gives the same bits
/// on any number of threads. Does nothing where nothing was captured.
void fit_wedges(Level& level, const CapturedSurface& captured, const WedgeOptions& options = {});

/// The same for what a surface shows that the level is one of, by the normals and colours of its vertices:
/// where the captured surface is no longer at hand. Does nothing where it has none.
void fit_wedges(Level& level, const Mesh& surface, const WedgeOptions& options = {});

} // namespace glcast
