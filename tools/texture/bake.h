// Textures of a level of detail, baked from the captured images.
// Natvig 2006, "future work"; normal maps for simplified meshes: Cohen, Olano and Manocha 1998,
// "Appearance-preserving simplification".
#pragma once
#include "tools/mesh/level.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

inline constexpr int smallest_texture = 64, largest_texture = 8192;

struct TextureOptions {
    int size =
        2048; ///< texels along an edge of the atlas; a power of two from smallest_texture to largest_texture
    int gutter =
        8; ///< texels between charts, 2 to 64; fewer, but at least 2, where charts are too many for that
    double texels_per_sample = 1; ///< along an axis, 1 at most: no more are made even where there is room; a texel is the
                                  ///< mean of what it covers
    bool smallest = false;        ///< the smallest atlas, up to `size`, that holds so many
};

struct TextureReport {
    std::size_t charts = 0;
    int size = 0;                 ///< texels along an edge
    int gutter = 0;               ///< texels between charts
    double texels_per_sample = 0; ///< along an axis; 1 at most: a texel a pixel of the capture
    std::size_t texels = 0;       ///< that show the surface; the gutters are not counted
    std::size_t texels_unseen =
        0; ///< of these, where no ray saw the surface: what lies behind a closing, or the vertices' colours
};

/// Textures a closed level. Its normals become those that a normal map is made for (shading_normals.h): of its wedges,
/// whose tangent frames end where they do, so that creases stay sharp; or of its vertices, where it has none. Colours of
/// vertices stay, those of wedges, which a texture hides, go. Throws std::runtime_error when options are out of range or
/// the mesh is empty, AtlasTooSmall (atlas.h) when there are too many charts. The same input gives the same texture, bit for bit, on any
/// number of threads.
void bake_texture(Level& level, const CapturedSurface& captured, const TextureOptions& options,
                  TextureReport* report = nullptr);

/// The same for a level without wedges.
Texture bake_texture(Mesh& mesh, const CapturedSurface& captured, const TextureOptions& options,
                     TextureReport* report = nullptr);

} // namespace glcast
