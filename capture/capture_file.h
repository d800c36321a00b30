// Writing a capture: multi-part OpenEXR, one part per view and layer (docs/reference/capture-format.md).
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/view.h"
#include "capture/view_image.h"

namespace glcast {

inline constexpr int capture_format_version = 3; ///< the newest that is read
inline constexpr int most_seen_places = 32;
inline constexpr const char* backs_reversed = "reversed"; ///< the one value of glcast.backs

/// What is true of the whole capture; in the header of every part.
struct CaptureInfo {
    int n = 0;
    Box box;
    glm::dmat4 eye_to_capture{1.0};
    /// Reference views (capture/reference_views.h): the frame of their capture to this one. Else none.
    std::optional<glm::dmat4> from_capture;
    /// Where the program's own eye is, capture frame. None where all its rays are parallel, in reference
    /// views and in older captures.
    std::optional<glm::dvec3> eye;
    /// Places in free space, capture frame, that the eye sees through faces which the program culls: what may
    /// be rooms without their near walls. At most `most_seen_places`.
    std::vector<glm::dvec3> seen_places;
    std::string program;  ///< file name of the host program
    long frame = 0;       ///< number of the frame, from 1
    std::string renderer; ///< GL_RENDERER
    std::string normals;  ///< "signed" or "six"
    std::string glcast_version;
    bool both_sides = false; ///< hits are shown as either side sees them
    /// Not with both_sides. All that is lit is lit on both sides: a viewer on the other side of a hit sees
    /// the reverse of its normal.
    bool reversed_backs = false;
    std::map<std::string, long> not_understood; ///< entry point or reason -> how often

    /// Known when all images are made: CaptureWriter::finish() sets them.
    Layers layers = Layers::outer;
    LayerMethod layer_method = LayerMethod::none;
    std::array<int, 3> layer_count{1, 1, 1}; ///< parts -a.0, -a.1, ... of each axis
};

/// Why a mesh cannot be made in that box: not finite, or not so large that 4096 places between two samples
/// are different doubles, and that floats hold squares of it. Null where it can.
const char* why_no_box(const Box& box, int n);

/// "glcast.seenPlace.7"
std::string seen_place_name(std::size_t number);

/// "+x.0": side, axis, layer.
std::string part_name(const View& view);

/// "outer", "incomplete", "complete"; "none", "peel", "slab": as the file spells them.
const char* layers_name(Layers layers);
const char* layer_method_name(LayerMethod method);

/// Writes to a temporary name beside `path` and renames in finish(); without finish() nothing is left.
/// Parts are compressed on a thread of the writer's own (capture/band_writer.h), which lives until finish();
/// at most the lines of one part wait for it uncompressed. Never throws.
class CaptureWriter {
  public:
    /// `most_parts`: how many images there may be. Room is kept for their headers: a hole in the file where
    /// fewer come. Check error() after.
    CaptureWriter(std::string path, const CaptureInfo& info, int most_parts);
    ~CaptureWriter();
    CaptureWriter(const CaptureWriter&) = delete;
    CaptureWriter& operator=(const CaptureWriter&) = delete;

    /// In any order, but layer k of an axis after its layer k - 1.
    bool add(const ViewImage& image);
    /// False when one of the six views of layer 0 is missing, or `layers` does not go with what was added.
    bool finish(Layers layers = Layers::outer, LayerMethod method = LayerMethod::none);
    const std::string& error() const; ///< one line, empty while all is well

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast
