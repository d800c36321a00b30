#include "tools/io/glb_textures.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "tools/io/glb_accessor.h"
#include "tools/picture/png.h"
#include "tools/picture/sample.h"

namespace glcast::format {
namespace {

int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

/// Square to the normal, where nobody says.
glm::vec4 some_tangent(const glm::vec3& normal) {
    const glm::vec3 other = std::abs(normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 across = glm::cross(normal, other);
    const float length = glm::length(across);
    return length > 0 ? glm::vec4(across / length, 1) : glm::vec4(1, 0, 0, 1);
}

void flatten(Picture& normal, const Picture& like) {
    normal.width = like.width, normal.height = like.height;
    normal.rgb.resize(like.rgb.size());
    for (std::size_t k = 0; k < normal.rgb.size(); ++k) normal.rgb[k] = k % 3 == 2 ? 255 : 128;
}

/// What the texture shows at a vertex, at the first of its corners.
void take_colours(Level& level) {
    std::vector<bool> done(level.mesh.positions.size(), false);
    level.mesh.colours.assign(level.mesh.positions.size(), glm::vec3(0));
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = level.mesh.triangles[t][k];
            if (done[v]) continue;
            done[v] = true;
            level.mesh.colours[v] = sample(level.texture.colour, level.texture.coordinates[t][k]);
        }
}

} // namespace

void TextureReader::add(const tinygltf::Primitive& primitive, const Mesh& mesh, std::size_t first_vertex,
                        std::size_t first_triangle, const glm::dmat3& turn) {
    if (!whole || mesh.triangles.size() == first_triangle) return;
    whole = false;
    if (primitive.material < 0 || attribute(primitive, "TEXCOORD_0") < 0) return;
    if (material >= 0 && material != primitive.material) return;
    material = primitive.material;
    const auto& colour = at(model.materials, material, "a material").pbrMetallicRoughness.baseColorTexture;
    if (colour.index < 0 || colour.texCoord != 0 || colour.extensions.contains("KHR_texture_transform"))
        return;
    if (texture.coordinates.size() != first_triangle) return; // one before had none
    whole = true;
    add_corners(primitive, mesh, first_vertex, first_triangle, turn);
}

void TextureReader::add_corners(const tinygltf::Primitive& primitive, const Mesh& mesh,
                                std::size_t first_vertex, std::size_t first_triangle,
                                const glm::dmat3& turn) {
    const Elements places(model, attribute(primitive, "TEXCOORD_0"));
    std::optional<Elements> directions;
    if (const int accessor = attribute(primitive, "TANGENT"); accessor >= 0)
        directions.emplace(model, accessor);
    if (places.components() < 2 || (directions && directions->components() < 4))
        refuse("has an attribute of too few components");
    tangents = tangents && directions;
    const float side = glm::determinant(turn) < 0 ? -1 : 1;
    for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t) {
        auto& coordinates = texture.coordinates.emplace_back();
        auto& tangent = texture.tangents.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const std::size_t v = mesh.triangles[t][k] - first_vertex;
            if (v >= places.count() || (directions && v >= directions->count()))
                refuse("has fewer attributes than vertices");
            coordinates[k] = glm::vec2(places.get(v, 0), places.get(v, 1));
            if (!std::isfinite(coordinates[k].x) || !std::isfinite(coordinates[k].y))
                refuse("a texture coordinate is not finite");
            if (!directions) continue;
            const glm::dvec3 along = turn * directions->vec3(v);
            const double length = glm::length(along);
            tangent[k] = std::isfinite(length) && length > 0
                             ? glm::vec4(glm::vec3(along / length), directions->get(v, 3) < 0 ? -side : side)
                             : glm::vec4(1, 0, 0, side);
        }
    }
}

Picture TextureReader::picture(int index) const {
    const int source = at(model.textures, index, "a texture").source;
    if (source < 0) return {}; // in an extension
    const tinygltf::Image& image = at(model.images, source, "an image");
    if (image.bufferView < 0 || (image.mimeType != "image/png" && image.mimeType != "image/jpeg")) return {};
    const auto& view = at(model.bufferViews, image.bufferView, "a buffer view");
    const auto& data = at(model.buffers, view.buffer, "a buffer").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        refuse("has a picture beyond its buffer");
    return decode_picture({reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength});
}

void TextureReader::finish(Level& level) {
    if (!whole || texture.coordinates.empty() || texture.coordinates.size() != level.mesh.triangles.size())
        return;
    const auto& described = model.materials[std::size_t(material)];
    texture.colour = picture(described.pbrMetallicRoughness.baseColorTexture.index);
    if (texture.colour.rgb.empty()) return;
    const auto& normal = described.normalTexture;
    if (tangents && normal.index >= 0 && normal.texCoord == 0) texture.normal = picture(normal.index);
    if (texture.normal.width != texture.colour.width || texture.normal.height != texture.colour.height)
        flatten(texture.normal, texture.colour);
    const bool have_normals = has_normals(level.mesh, level.wedges);
    for (std::size_t t = 0; t < texture.tangents.size() && !tangents; ++t) {
        std::array<glm::vec3, 3> normals;
        normals.fill(glm::vec3(0, 0, 1));
        if (have_normals) normals = corner_normals(level.mesh, level.wedges, t);
        for (int k = 0; k < 3; ++k) texture.tangents[t][k] = some_tangent(normals[k]);
    }
    level.texture = std::move(texture);
    take_colours(level);
}

} // namespace glcast::format
