// What the header of a capture says. It is parsed here and nowhere else (docs/reference/capture-format.md, "Reading").
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "capture/capture_file.h"
#include "capture/exr_compress.h"
#include "tools/io/input_file.h"

namespace glcast {

/// In the order in which a part stores them: A B G N.V N.X N.Y N.Z R Z; of both sides A B G N.V N.X N.Y N.Z R
/// T.B T.G T.N.V T.N.X T.N.Y T.N.Z T.R Z.
inline constexpr std::size_t channel_count = 9, both_channel_count = 16;

/// What is of one part alone.
struct PartHeader {
    View view;
    exr::Compression compression = exr::Compression::none;
    int covered = 0, with_normal = 0; ///< pixels
    std::vector<bool> half;           ///< of each channel: 2 bytes a pixel, else 4
};

struct CaptureHeader {
    CaptureInfo info; ///< the same in all parts
    std::vector<PartHeader> parts;
    std::uint64_t tables_at = 0; ///< where the offset tables begin
};

/// Every part must be ours (`glcast.format`), n x n, with the channels of docs/reference/capture-format.md, and one of
/// the views of the header's layers. n is backed by as many bytes of the file as the best compression needs.
/// Throws std::runtime_error: what is wrong, without the file's name.
CaptureHeader read_capture_header(const InputFile& file);

} // namespace glcast
