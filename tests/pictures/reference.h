// What the program drew under frames that were not captured, and the same of a level.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "capture/view_image.h"
#include "tools/mesh/level.h"
#include "tools/render/raster.h"

namespace glcast::pictures {

/// Where an image stands in the capture frame. `from_capture`: the capture frame to the image's own, a
/// rotation.
struct ReferenceView {
    std::string name;      ///< "1 -x": number of the frame, side
    OrthoView camera;      ///< capture frame
    SeenImage seen;        ///< as drawn, no light
    std::vector<char> lit; ///< covered pixels that have a normal
};

ReferenceView reference_view(const ViewImage& image, const Box& box, const glm::dmat4& from_capture,
                             std::string name);

/// All of the views beside the capture (GLCAST_REFERENCE_VIEWS). Throws std::runtime_error where there are
/// none, one cannot be read, or belongs to another frame.
std::vector<ReferenceView> read_references(const std::filesystem::path& capture);

/// Colour times light: ambient .3, .45 from the camera, .25 from its upper left, as far as the normal is
/// turned there. Background is light grey. The level has no light where the reference has none.
Picture lit(const ReferenceView& view);
Picture lit(const SeenImage& level, const ReferenceView& where);

/// Over all pixels of all views at once.
struct Likeness {
    double psnr = 0;       ///< all pixels, background too
    double psnr_worst = 0; ///< of the worst single view
    double ssim = 0;       ///< mean of the views
};
struct PictureError {
    Likeness antialiased;    ///< a pixel is the mean of all its samples, after light
    Likeness one_sample;     ///< a pixel is one of its samples
    double psnr_covered = 0; ///< samples that the original or the level covers
    double psnr_inside = 0;  ///< samples that both cover: colour and light, whatever the outlines do
    // What would be left of `antialiased` if one of its two parts were perfect:
    double psnr_outline = 0;     ///< samples that one covers alone are off, those that both cover perfect
    double psnr_filling = 0;     ///< samples that both cover are off, the others perfect
    double background_share = 0; ///< samples that neither covers
    int width = 0;               ///< pixels of a picture
    std::size_t views = 0;
};
/// Original and level are drawn with the same `samples` x `samples` samples a pixel, one in each pixel of the
/// reference view, whose width they divide.
PictureError picture_error(const Level& level, std::span<const ReferenceView> views, int samples = 1);
/// The same for several numbers of samples.
std::vector<PictureError> picture_errors(const Level& level, std::span<const ReferenceView> views,
                                         std::span<const int> samples);

} // namespace glcast::pictures
