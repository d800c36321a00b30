// .mtl: the colours of the materials of an .obj.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/mesh/picture.h"

namespace glcast::format {

struct Material {
    std::optional<glm::vec3> colour; ///< Kd, display values
    Picture picture;                 ///< map_Kd, where it is a PNG or JPEG beside the mesh

    bool empty() const { return !colour && picture.rgb.empty(); }
    /// At texture coordinates as in the file (v upwards); the picture repeats. It hides Kd, as in Blender.
    glm::vec3 at(const glm::vec2& place) const;
};

/// Those of `names`, in that order, as the files `libraries` beside `mesh` describe them. What is missing or damaged stays
/// empty.
std::vector<Material> read_materials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
                                     const std::vector<std::string>& names);

/// One of a picture alone.
Material picture_material(const std::filesystem::path& mesh, const std::string& picture);

} // namespace glcast::format
