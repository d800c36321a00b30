// Wavefront .obj: read by OpenMesh; digits of doubles, colours behind v, and materials by us.
#include "tools/io/mesh_format.h"
#include "tools/io/obj_materials.h"
#include "tools/io/obj_text.h"
#include "tools/io/openmesh_reader.h"

namespace glcast::format {
namespace {

constexpr glm::vec3 no_material(0.8f); ///< as Blender shows it

/// Of corners where some face has a material with a colour or a picture.
void add_material_colours(const ObjText& text, const std::vector<Material>& materials, Soup& soup) {
    std::size_t at = 0;
    for (std::size_t f = 0; f < text.sizes.size(); ++f)
        for (std::uint32_t k = 0; k < text.sizes[f]; ++k, ++at) {
            const int number = text.materials[f];
            const bool known = number >= 0 && !materials[std::size_t(number)].empty();
            soup.corner_colours.push_back(known ? materials[std::size_t(number)].at(soup.corner_places[at])
                                                : no_material);
        }
}

} // namespace

std::vector<Level> read_obj(std::string_view bytes, const std::filesystem::path& path) {
    ObjText text = obj_text(bytes);
    if (text.positions.empty()) refuse("holds no vertices");
    if (text.sizes.empty()) refuse("holds no triangles");
    Soup soup = read_with_openmesh(text.plain, OpenMeshKind::obj, text.sizes);
    if (soup.positions.size() != text.positions.size() || soup.sizes != text.sizes)
        refuse("OpenMesh finds other vertices and faces in it than stand there");
    soup.positions = std::move(text.positions);
    if (!text.colours.empty()) {
        scale_colours(text.colours, false);
        soup.colours = std::move(text.colours);
    } else {
        const std::vector<Material> materials = read_materials(path, text.libraries, text.names);
        if (std::any_of(materials.begin(), materials.end(), [](const Material& m) { return !m.empty(); }))
            add_material_colours(text, materials, soup);
    }
    return {level_of(std::move(soup))};
}

} // namespace glcast::format
