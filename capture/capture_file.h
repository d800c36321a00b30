// Writing a capture: multi-part OpenEXR, one part per view and layer (docs/capture-format.md).
#pragma once
#include <map>
#include <memory>
#include <string>

#include "capture/view.h"
#include "capture/view_image.h"

namespace glcast {

inline constexpr int capture_format_version = 1;

/// What is true of the whole capture; in the header of every part.
struct CaptureInfo {
    int n = 0;
    Box box;
    glm::dmat4 eye_to_capture{1.0};
    std::string program;       ///< file name of the host program
    long frame = 0;            ///< number of the frame, from 1
    std::string renderer;      ///< GL_RENDERER
    std::string normals;       ///< "signed" or "six"
    std::string glcast_version;
    std::map<std::string, long> not_understood; ///< entry point or reason -> how often
};

/// "+x.0": side, axis, layer.
std::string part_name(const View& view);

/// Writes to a temporary name beside `path` and renames in finish(); without finish() nothing is left.
/// Each part is compressed as it is added, so at most one part is held uncompressed. Never throws.
class CaptureWriter {
  public:
    /// `parts`: how many images will be added. Check error() after.
    CaptureWriter(std::string path, const CaptureInfo& info, int parts);
    ~CaptureWriter();
    CaptureWriter(const CaptureWriter&) = delete;
    CaptureWriter& operator=(const CaptureWriter&) = delete;

    bool add(const ViewImage& image);
    bool finish();
    const std::string& error() const; ///< one line, empty while all is well

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast
