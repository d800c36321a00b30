// .glb by tinygltf: the shown scene with its transforms as level 0, the nodes that MSFT_lod names as further
// levels.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include "tools/io/glb_accessor.h"
#include "tools/io/glb_container.h"
#include "tools/io/glb_extras.h"
#include "tools/io/glb_textures.h"
#include "tools/io/meshopt.h"
#include "tools/io/seams.h"

namespace glcast::format {
namespace {

using tinygltf::Model;
using tinygltf::Value;

glm::dmat4 transform_of(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 m(1);
    if (node.translation.size() == 3)
        m[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
    if (node.rotation.size() == 4)
        m = m * glm::mat4_cast(
                    glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
    if (node.scale.size() == 3)
        for (int k = 0; k < 3; ++k) m[k] *= node.scale[k];
    return m;
}

/// Corners of triangles out of the indices of a primitive, by its mode.
void add_triangles(Mesh& mesh, int mode, std::size_t count,
                   const std::function<std::uint32_t(std::size_t)>& index) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
        for (std::size_t k = 0; k + 2 < count; k += 3)
            mesh.triangles.push_back({index(k), index(k + 1), index(k + 2)});
        break;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        for (std::size_t k = 0; k + 2 < count; ++k)
            mesh.triangles.push_back({index(k), index(k + 1 + k % 2), index(k + 2 - k % 2)});
        break;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        for (std::size_t k = 1; k + 1 < count; ++k)
            mesh.triangles.push_back({index(0), index(k), index(k + 1)});
        break;
    default:
        break; // points and lines have no surface
    }
}

class GlbReader {
  public:
    explicit GlbReader(const Model& model) : model(model) {}

    Level level(const std::vector<int>& nodes) {
        Level level;
        normals = colours = true;
        TextureReader texture(model);
        textures = &texture;
        copies = {};
        visited.assign(model.nodes.size(), false);
        for (int node : nodes) add_node(level, node, glm::dmat4(1));
        if (!normals) level.mesh.normals.clear();
        if (!colours) level.mesh.colours.clear();
        level.wedges = copies.wedges(level.mesh);
        texture.finish(level);
        return level;
    }

  private:
    void add_node(Level& level, int index, const glm::dmat4& parent) {
        const tinygltf::Node& node = at(model.nodes, index, "a node");
        if (visited[index]) refuse("its nodes are no tree");
        visited[index] = true;
        const glm::dmat4 m = parent * transform_of(node);
        if (node.mesh >= 0) add_mesh(level, at(model.meshes, node.mesh, "a mesh"), m);
        for (int child : node.children) add_node(level, child, m);
    }

    void add_mesh(Level& level, const tinygltf::Mesh& mesh, const glm::dmat4& m) {
        if (level.name.empty()) level.name = mesh.name;
        read_extras(mesh.extras, level);
        for (const tinygltf::Primitive& primitive : mesh.primitives) add_primitive(level.mesh, primitive, m);
        const double seams = number_in(mesh.extras, "seams", -1);
        if (seams >= 0 && seams < double(model.accessors.size())) join_seams(level.mesh, int(seams));
    }

    /// Where the file is as we wrote it; vertices of what came before are no originals.
    void join_seams(Mesh& mesh, int accessor) {
        const Elements elements(model, accessor);
        if (elements.count() >= mesh.positions.size()) return;
        std::vector<std::uint32_t> originals;
        for (std::size_t k = 0; k < elements.count(); ++k)
            originals.push_back(std::uint32_t(std::clamp(elements.get(k, 0), 0.0, double(UINT32_MAX))));
        if (are_copies(mesh, originals)) copies.join(mesh, originals);
    }

    void add_primitive(Mesh& mesh, const tinygltf::Primitive& primitive, const glm::dmat4& m) {
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return;
        const std::size_t base = mesh.positions.size(), first = mesh.triangles.size();
        const auto accessor = [&](const char* name) {
            const auto found = primitive.attributes.find(name);
            return found == primitive.attributes.end() ? -1 : found->second;
        };
        const Elements positions(model, accessor("POSITION"));
        if (base + positions.count() > UINT32_MAX) refuse("has too many vertices");
        for (std::size_t v = 0; v < positions.count(); ++v)
            mesh.positions.emplace_back(m * glm::dvec4(positions.vec3(v), 1));
        add_normals(mesh, accessor("NORMAL"), m);
        add_colours(mesh, accessor("COLOR_0"), primitive.material);
        if (primitive.indices < 0) {
            add_triangles(mesh, primitive.mode, positions.count(),
                          [&](std::size_t k) { return std::uint32_t(base + k); });
        } else {
            const Elements indices(model, primitive.indices);
            add_triangles(mesh, primitive.mode, indices.count(), [&](std::size_t k) {
                const double i = indices.get(k, 0);
                if (!(i >= 0 && i < double(positions.count())))
                    refuse("a face refers to a vertex that is not there");
                return static_cast<std::uint32_t>(base + std::size_t(i));
            });
        }
        textures->add(primitive, mesh, base, first, glm::dmat3(m));
    }

    void add_normals(Mesh& mesh, int accessor, const glm::dmat4& m) {
        const std::size_t base = mesh.normals.size();
        mesh.normals.resize(mesh.positions.size(), glm::vec3(0));
        if (accessor < 0) {
            normals = false;
            return;
        }
        const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(m)));
        const Elements elements(model, accessor);
        for (std::size_t v = 0; v < std::min(elements.count(), mesh.normals.size() - base); ++v)
            mesh.normals[base + v] = turn * elements.vec3(v);
    }

    /// Linear light times the material's base colour, back to display values; a material alone counts as
    /// colour.
    void add_colours(Mesh& mesh, int accessor, int material) {
        const std::size_t base = mesh.colours.size();
        glm::dvec3 factor(1);
        if (material >= 0) {
            const auto& f = at(model.materials, material, "a material").pbrMetallicRoughness.baseColorFactor;
            if (f.size() >= 3) factor = {f[0], f[1], f[2]};
        }
        if (accessor < 0 && factor == glm::dvec3(1)) colours = false;
        mesh.colours.resize(mesh.positions.size(), glm::vec3(1));
        for (std::size_t v = base; v < mesh.colours.size(); ++v)
            for (int k = 0; k < 3; ++k) mesh.colours[v][k] = to_display(float(factor[k]));
        if (accessor < 0) return;
        const Elements elements(model, accessor);
        for (std::size_t v = 0; v < std::min(elements.count(), mesh.colours.size() - base); ++v) {
            const glm::dvec3 linear = elements.vec3(v) * factor;
            for (int k = 0; k < 3; ++k) mesh.colours[base + v][k] = to_display(float(linear[k]));
        }
    }

    const Model& model;
    std::vector<bool> visited;
    TextureReader* textures = nullptr; ///< of the level that is read
    CopyJoiner copies;                 ///< likewise
    bool normals = true, colours = true; ///< every primitive of the level has them
};

/// Pictures are decoded when a level turns out to need them.
bool no_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return true;
}

bool is_compressed(const GlbChunks& chunks) {
    const auto used = chunks.json.find("extensionsUsed");
    if (used == chunks.json.end() || !used->is_array()) return false;
    return std::find(used->begin(), used->end(), meshopt_extension) != used->end();
}

Model load_plain(std::string_view bytes) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(no_image, nullptr);
    Model model;
    std::string error, warning;
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    if (!loader.LoadBinaryFromMemory(&model, &error, &warning, data, static_cast<unsigned>(bytes.size()))) {
        error = error.substr(0, error.find('\n'));
        refuse("is damaged or no glTF 2.0: " + error);
    }
    for (const std::string& extension : model.extensionsRequired)
        if (extension != "KHR_mesh_quantization")
            refuse("needs the extension " + extension + ", which is not read");
    return model;
}

Model load(std::string_view bytes) {
    const GlbChunks chunks = glb_chunks(bytes);
    return is_compressed(chunks) ? load_plain(meshopt_decompressed(chunks)) : load_plain(bytes);
}

/// The nodes that MSFT_lod puts behind the only node of the scene.
std::vector<int> further_levels(const Model& model, const std::vector<int>& shown) {
    std::vector<int> nodes;
    if (shown.size() != 1) return nodes;
    const auto& extensions = at(model.nodes, shown[0], "a node").extensions;
    const auto found = extensions.find("MSFT_lod");
    if (found == extensions.end() || !found->second.IsObject() || !found->second.Has("ids")) return nodes;
    const Value& ids = found->second.Get("ids");
    for (std::size_t k = 0; k < ids.ArrayLen(); ++k) nodes.push_back(ids.Get(int(k)).GetNumberAsInt());
    return nodes;
}

} // namespace

std::vector<Level> read_glb(std::string_view bytes) {
    const Model model = load(bytes);
    std::vector<int> shown;
    if (!model.scenes.empty())
        shown = at(model.scenes, std::max(model.defaultScene, 0), "a scene").nodes;
    else
        for (std::size_t k = 0; k < model.nodes.size(); ++k) shown.push_back(int(k));
    GlbReader reader(model);
    std::vector<Level> levels;
    levels.push_back(reader.level(shown));
    for (int node : further_levels(model, shown)) levels.push_back(reader.level({node}));
    for (std::size_t k = 0; k < levels.size(); ++k)
        if (levels[k].name.empty()) levels[k].name = "level " + std::to_string(k);
    return levels;
}

} // namespace glcast::format
