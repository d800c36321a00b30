// A glTF file (.glb or .gltf) with what it names, as tinygltf's model. Internal.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace glcast::format {

struct GltfFile {
    tinygltf::Model model;
    std::vector<std::string> picture_names; ///< URI of each image; empty where it stands in a buffer
    std::filesystem::path path;
    std::size_t bytes = 0; ///< of the file and of all buffers that it names
};

/// tinygltf opens nothing: buffers are read by read_beside(), from the file's own folder and below. Each is
/// named once, and all of it is there. Buffers compressed by EXT_meshopt_compression are unpacked. Throws
/// std::runtime_error without the file's name.
GltfFile load_gltf(std::string_view bytes, const std::filesystem::path& path);

/// The bytes of a picture, in its buffer, in its URI or beside the file; empty where there is none.
std::string picture_bytes(const GltfFile& file, int image);

} // namespace glcast::format
