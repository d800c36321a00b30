// Which levels of a run get textures, and how large.
#pragma once
#include <optional>
#include <string>

#include "tools/mesh/level.h"
#include "tools/texture/bake.h"

namespace glcast {

struct TextureChoice {
    /// by_need: of a level that a plain colour a triangle, by materials, would show wrongly; as large as it
    /// needs.
    enum class Kind { by_need, none, sized } kind = Kind::by_need;
    int size = 0; ///< of sized: texels along an edge
};

/// How wrongly a level is shown by its vertices, or wedges: root of the mean square, over its surface, of the
/// difference from what was captured there, as light of a picture, 0..1. Colours count as they are; a normal
/// as much as it changes the light of the two lamps that `glcast render` has, seen from anywhere.
double shown_error(const Level& level, const CapturedSurface& captured);

/// By `choice`. Without a texture the corners of each triangle get one of a few plain colours where that
/// shows the level as well (tools/mesh/face_colours.h). What by_need makes of a level with `pixels` has two
/// texels a pixel, at most one a sample; of another, one texel a sample. An atlas that is too small for the
/// charts is made larger, and where none is large enough the level keeps the colours of its vertices:
/// `why_not` says so then. What came of it, where there is a texture.
std::optional<TextureReport> texture_level(Level& level, const CapturedSurface& captured,
                                           const TextureChoice& choice, std::string& why_not);

} // namespace glcast
