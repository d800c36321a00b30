// From the six images to a closed surface. Knows nothing of files or GL.
// Carving, thin parts and colours: Natvig 2006, sections 3-5. Contour: Ju, Losasso, Schaefer and Warren 2002,
// "Dual contouring of Hermite data", with one vertex per surface patch of a cell, so that it is two-manifold.
#pragma once
#include <span>

#include "capture/view_image.h"
#include "tools/mesh/mesh.h"
#include "tools/reconstruct/mend.h"

namespace glcast {

enum class SurfaceMethod {
    contour, ///< dual contouring on the lattice with exact crossings and captured normals
    cubes,   ///< the paper's: a square per exposed face of each filled sub-cube, colour and normal per face
};

struct ReconstructOptions {
    SurfaceMethod method = SurfaceMethod::contour;
    double close_gaps = 1; ///< radius in samples of the closing of the depth images; 0 keeps every gap
    bool geometric_normals = false; ///< recompute normals from the surface instead of those drawn
};

struct ReconstructReport {
    std::size_t filled_samples = 0;
    std::size_t thin_samples = 0;          ///< filled only because a sheet passes by
    std::size_t crossings = 0;             ///< lattice edges that change sign
    std::size_t unsupported_crossings = 0; ///< of these, how many no ray saw
    std::size_t vertices_without_pixel =
        0; ///< colour of a neighbour on the surface, normal of the surface itself
    MendReport mended;
    double carve_seconds = 0, surface_seconds = 0, attribute_seconds = 0;
};

/// `images` holds layer 0 of all six views, same n. The mesh is a closed two-manifold, asserted before it is
/// returned (throws std::logic_error, which is a bug), and does not pass through itself, in capture-frame
/// units, normals unit length, colours as drawn. Throws std::runtime_error when a view is missing or nothing
/// is filled. The same images give the same mesh, bit for bit, whatever the number of threads.
Mesh reconstruct(std::span<const ViewImage> images, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report = nullptr);

} // namespace glcast
