// From the captured images to a closed surface. Knows nothing of files or GL.
// Carving, thin parts and colours: Natvig 2006, sections 3-5. Contour: Ju, Losasso, Schaefer and Warren 2002,
// "Dual contouring of Hermite data", with one vertex per surface patch of a cell, so that it is two-manifold.
#pragma once
#include <span>

#include "capture/view_image.h"
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/hits.h"
#include "tools/reconstruct/mend.h"

namespace glcast {

class CapturedSurface;

enum class SurfaceMethod {
    contour, ///< dual contouring on the lattice with exact crossings and captured normals
    cubes,   ///< the paper's: a square per exposed face of each filled sub-cube, colour and normal per face
};

/// What counts as outside (docs/design/method.md).
enum class ExteriorRule {
    layers, ///< what free space reaches and somebody can see; needs every surface along the axes
    axes,   ///< the paper's: what one of the six views sees past
};

struct ReconstructOptions {
    SurfaceMethod method = SurfaceMethod::contour;
    ExteriorRule exterior = ExteriorRule::layers;
    bool complete_layers =
        false;             ///< the images hold every surface; else the rule is `axes` whatever was asked
    double close_gaps = 1; ///< radius in samples: passages up to 2 r + 1 wide are closed; 0 keeps every gap
    double sheet_thickness = 0.1;   ///< samples, 0.01..1: between the sides of a surface without thickness
    bool geometric_normals = false; ///< recompute normals from the surface instead of those drawn
    /// Places in free space, capture frame, from which the inside of something is seen: the program's own
    /// eye, and what it sees through culled faces. Those outside of the box, or in space that counts as
    /// outside anyway, change nothing.
    std::vector<glm::dvec3> eyes = {};
};

struct ReconstructReport {
    ExteriorRule exterior = ExteriorRule::axes; ///< the rule that was used
    std::size_t hidden_samples = 0;             ///< free, but nobody outside can see them, and so filled
    std::size_t filled_samples = 0;
    std::size_t thin_samples = 0;          ///< filled only because a sheet passes by
    std::size_t crossings = 0;             ///< lattice edges that change sign
    std::size_t unsupported_crossings = 0; ///< of these, how many no ray saw
    double unsupported_area_share = 0;     ///< of the surface's area, what lies about such crossings
    std::size_t vertices_without_pixel =
        0; ///< colour of a neighbour on the surface, normal of the surface itself, or those behind a closing
    /// Of the surface's area: where the normal that was drawn is more than 60 degrees off the surface that
    /// was drawn. What is lit by such normals looks right in the program's own light alone. 0 for cubes.
    double disagreeing_normals_share = 0;
    MendReport mended;
    double carve_seconds = 0, surface_seconds = 0, attribute_seconds = 0;
};

/// `hits`: the images of a capture, all six outer views among them. The mesh is a closed two-manifold,
/// asserted before it is returned (throws std::logic_error, which is a bug), and does not pass through
/// itself, in capture-frame units, normals unit length, colours as drawn. Throws std::runtime_error when a
/// view is missing or nothing is filled. The same images give the same mesh, bit for bit, whatever the number
/// of threads. `captured`, when given, takes what the images show of the surface (captured_surface.h).
Mesh reconstruct(HitBuilder&& hits, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report = nullptr, CapturedSurface* captured = nullptr);

/// The same from images in memory. Throws also when they differ in size.
Mesh reconstruct(std::span<const ViewImage> images, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report = nullptr, CapturedSurface* captured = nullptr);

} // namespace glcast
