// The bones of a multi-part OpenEXR file, checked before OpenEXR itself may allocate anything for it.
#pragma once
#include <cstdint>
#include <filesystem>

namespace glcast {

struct CaptureLayout {
    int n = 0, parts = 0, format = 0;
    std::uint64_t file_bytes = 0;
};

/// Walks headers, offset tables and chunk heads. Every part must be ours (`glcast.format`), square, n x n,
/// with all its chunks complete and the last one ending where the file ends; so no truncation goes unseen,
/// and n is backed by as many bytes as the best compression needs. Throws std::runtime_error: what is wrong,
/// without the file's name.
CaptureLayout check_capture_layout(const std::filesystem::path& path);

} // namespace glcast
