// Reading a capture with OpenEXR, every part checked.
#pragma once
#include <filesystem>
#include <vector>

#include "capture/capture_file.h"

namespace glcast {

struct Capture {
    CaptureInfo info;
    std::vector<ViewImage> images; ///< any order; layer 0 of all six views is always there
    std::size_t file_bytes = 0;
};

/// Throws std::runtime_error with one clear line when the file is missing, truncated, foreign, of a newer
/// format version, or lacks a part. Never allocates more than the header honestly asks for.
Capture read_capture(const std::filesystem::path& path);

/// True when the file starts like OpenEXR.
bool looks_like_exr(const std::filesystem::path& path);

} // namespace glcast
