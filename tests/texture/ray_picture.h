// Pictures of a level by rays: a viewer of textures that shares no code with those who make them.
#pragma once
#include <glm/vec3.hpp>
#include <memory>

#include "tools/mesh/level.h"

namespace glcast::test {

enum class Show {
    lit,    ///< colour times a light at the viewer, a quarter of it ambient
    colour, ///< colours alone
    normal, ///< (n + 1) / 2
};

struct RayView {
    glm::dvec3 centre{0};       ///< middle of the picture
    double radius = 1;          ///< half of what it shows, model units
    glm::dvec3 along{0, 0, -1}; ///< direction of sight
    int size = 256;
    Show show = Show::lit;
    bool vertices = false; ///< colours and normals of the vertices, though there is a texture
};

class RayScene;

/// Of one level, which must outlive it.
class RayPictures {
  public:
    explicit RayPictures(const Level& level);
    ~RayPictures();
    /// Orthographic, on grey, four rays a pixel. Textures bilinear, shaded as glTF says.
    Picture operator()(const RayView& view) const;

  private:
    const Level& level;
    std::unique_ptr<const RayScene> scene;
};

/// Peak signal-to-noise ratio of all channels, dB; infinite for equal pictures. Of the pixels where one of
/// them shows something other than the background.
double psnr(const Picture& a, const Picture& b);

} // namespace glcast::test
