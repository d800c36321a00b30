// OpenMesh's readers, handing over what they read as a Soup: no half-edges are made, so no rule of theirs drops a face.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "tools/io/soup.h"

namespace glcast::format {

enum class OpenMeshKind { obj, ply, stl_text, stl_binary };

/// Reads `text` in a child process (reader_process.h). Positions, normals and colours are floats; colours 0..1 where the format
/// says so. Of .obj, where every `v` must have a colour (obj_text.h), corners keep their own normals and places;
/// `sizes`: corners of each face of the .obj. Throws std::runtime_error.
Soup read_with_openmesh(std::string_view text, OpenMeshKind kind, std::span<const std::uint32_t> sizes = {});

} // namespace glcast::format
