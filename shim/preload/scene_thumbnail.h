// A small picture of one group of draws as the program shows it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "capture/engine.h"
#include "capture/gl/override_table.h"

namespace glcast::preload {

/// Of a picture of what is seen through a viewport.
struct PictureSize {
    int width, height;
    PictureSize(const std::array<GLint, 4>& viewport, int longer_side);
};

struct Thumbnail {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; ///< bottom row first; what is not drawn is grey
    double coverage = 0;           ///< share of the viewport that is drawn on, 0 to 1
    bool flat = false;             ///< all of it at one depth
};

enum class PictureFaces { program, all }; ///< as the program culls; or whatever it culls
/// Written where the program does; or by all that is drawn; or so, and what is in front shows whatever its
/// test.
enum class PictureDepths { program, all, nearest };

/// What the program draws, but where to and what it wipes away. One at a time on a thread.
class PictureTable {
  public:
    explicit PictureTable(const GlTable& gl, PictureFaces faces = PictureFaces::program,
                          PictureDepths depths = PictureDepths::program);
    ~PictureTable();
    PictureTable(const PictureTable&) = delete;
    PictureTable& operator=(const PictureTable&) = delete;

    const GlTable& table() const { return picture; }
    const GlTable& below() const { return real; }
    bool owns(GLenum cap) const;

  private:
    const GlTable& real;
    const bool culls;
    GlTable picture;
};

extern const OverrideRules picture_rules;

/// Draws into a framebuffer of ours, in the current context. `draw` plays the group through the table that it
/// is given; the program's viewport, scissor, stencil, clears and framebuffers are left out. `size`: of the
/// longer side.
Thumbnail draw_thumbnail(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool depth_reversed, int size);

/// Window depths, bottom row first; 1 where nothing is drawn.
struct DepthPicture {
    int width = 0, height = 0, stride = 0;
    std::vector<float> depth;
    float at(int x, int y) const { return depth[std::size_t(y) * stride + x]; }
};

/// As draw_thumbnail, and whatever is drawn writes its depth. `culls`: as the program culls; else all faces
/// are drawn. `depths` is not PictureDepths::program.
DepthPicture draw_depths(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool culls, int size, PictureDepths depths = PictureDepths::all);

} // namespace glcast::preload
