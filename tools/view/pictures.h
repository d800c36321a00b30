// The captured views as one sees them. Internal.
#pragma once
#include <glm/vec3.hpp>

#include "capture/view_image.h"
#include "tools/mesh/picture.h"
#include "tools/view/packing.h"

namespace glcast::view {

/// How a view is held, in the capture frame, as in `glcast render`: y up, but z up from -y and -z up from +y.
struct Stance {
    glm::ivec3 right{0}, up{0}, back{0}; ///< back: from the object to the camera
};
Stance stance(const View& view);

enum class What { colour, normal };

/// .png with alpha 0 where nothing was drawn, at most `most_pixels` wide; larger images are averaged. Normals
/// are shown as (n + 1) / 2 in the capture frame.
Bytes view_png(const ViewImage& image, What what, int most_pixels);

/// .png of a picture as it is.
Bytes picture_png(const Picture& picture);

} // namespace glcast::view
