// Reading a capture with OpenEXR, every part checked.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "capture/capture_file.h"

namespace glcast {

struct Capture {
    CaptureInfo info;
    std::vector<ViewImage>
        images; ///< in the order of the streaming form below; layer 0 of all six views is always there
    std::size_t file_bytes = 0;
};

/// What the file says of itself, its bones checked (headers, sizes, chunks) and no pixel read. Throws as
/// read_capture.
CaptureInfo read_capture_info(const std::filesystem::path& path);

/// Takes a part; nothing of it is held afterwards.
using PartSink = std::function<void(ViewImage&& image)>;

/// Parts one at a time, whatever their order in the file: -x.0, +x.0, -x.1, -x.2, ..., then y, then z. Beside
/// the part two depths a pixel are held, to check that the layers of each pixel are strictly increasing
/// between its first hit and its last. Throws as read_capture does; parts given before stay given.
CaptureInfo read_capture(const std::filesystem::path& path, const PartSink& sink);

/// Throws std::runtime_error with one clear line when the file is missing, truncated, foreign, of a newer
/// format version, or lacks a part. Never allocates more than the header honestly asks for.
Capture read_capture(const std::filesystem::path& path);

/// True when the file starts like OpenEXR.
bool looks_like_exr(const std::filesystem::path& path);

} // namespace glcast
