// The six views of a capture, for commands that show them beside a mesh.
#pragma once
#include <string>
#include <vector>

#include "capture/capture_file.h"

namespace glcast::cli {

struct CapturedSix {
    CaptureInfo info;
    std::vector<ViewImage> views; ///< layer 0 alone
};

/// Throws as read_capture does.
CapturedSix read_six_views(const std::string& file);

} // namespace glcast::cli
