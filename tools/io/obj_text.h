// The text of an .obj put into the form that OpenMesh reads, and what OpenMesh would lose of it.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace glcast::format {

struct ObjText {
    /// v, vn, vt and f alone, a line each: lines that were continued are whole, numbers fit floats, and every v has a colour, by which
    /// OpenMesh tells the corners (openmesh_reader.h).
    std::string plain;
    std::vector<glm::dvec3> positions; ///< with all digits, in the order of the v
    std::vector<glm::vec3> colours;    ///< of the v, on the file's scale; empty unless all have one
    std::vector<std::uint32_t> sizes;  ///< of faces: corners
    std::vector<std::uint32_t> lines;  ///< of faces: where they stand
    std::vector<int> materials;        ///< of faces: number in `names`, or -1
    std::vector<std::string> names;    ///< that faces use, each once
    std::vector<std::string> libraries; ///< named by mtllib
};

/// Throws std::runtime_error, with the line, on numbers and faces that cannot be understood.
ObjText obj_text(std::string_view bytes);

} // namespace glcast::format
