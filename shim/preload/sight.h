// How the program looks at each draw: the camera in its matrices, and what takes the draws of one camera to
// one eye space.
#pragma once
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "capture/camera.h"
#include "capture/gl/gl_table.h"

namespace glcast::preload {

struct Sight {
    glm::dmat4 projection{1.0};
    bool perspective = false;
    bool in_modelview = false; ///< the projection stands before the view in the modelview matrix
    /// What takes eye space, as the program's modelview makes it, to the screen's; where the projection is in
    /// the modelview, only its lens. Nothing where the matrices hold no camera.
    std::optional<Camera> camera;
    std::optional<DepthLine> depth;
};

/// What becomes of a draw's modelview matrix M so that the draw lies in the eye space of its group: rows M,
/// and `origin` added to the last column.
struct EyeMap {
    glm::dmat4 rows{1.0};
    glm::dvec4 origin{0};
    glm::dmat4 apply(const glm::dmat4& modelview) const;
};

/// The matrices of a frame's draws, one after the other.
class Sights {
  public:
    /// Valid until the next call.
    const Sight& look(const glm::dmat4& projection, const glm::dmat4& modelview,
                      const std::array<GLint, 4>& viewport);

    /// Some perspective holds no camera that could be told from what had come before it, and others do:
    /// looking again with what is known now may tell.
    bool may_know_more() const { return was_unknown && !known.empty(); }
    /// For that. Of draws that come.
    void look_again() { was_unknown = false, last = {}; }

    /// The lens of draws with this depth row.
    std::optional<Lens> lens_with(const DepthLine& line) const;

  private:
    std::optional<Camera> camera_of(const glm::dmat4& to_clip, const std::array<GLint, 4>& viewport);
    void remember(const Lens& lens, const glm::dmat4& to_clip);

    struct Known {
        Lens lens;
        DepthLine depth;
    };
    std::vector<Known> known;
    bool was_unknown = false;
    std::optional<Sight> last;
    std::array<GLint, 4> last_viewport{};
};

bool is_perspective(const glm::dmat4& projection);

} // namespace glcast::preload
