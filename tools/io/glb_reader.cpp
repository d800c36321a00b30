// .glb and .gltf by tinygltf: the shown scene with its transforms as level 0, the nodes that MSFT_lod names
// as further levels.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <set>
#include <tiny_gltf.h>

#include "tools/io/glb_accessor.h"
#include "tools/io/glb_extras.h"
#include "tools/io/glb_textures.h"
#include "tools/io/gltf_file.h"
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

std::size_t triangle_count(int mode, std::size_t corners) {
    return mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
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
        for (std::size_t k = 0; k + 2 < count; ++k) {
            const Triangle t{index(k), index(k + 1 + k % 2), index(k + 2 - k % 2)};
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
                mesh.triangles.push_back(t); // others join two strips
        }
        break;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        for (std::size_t k = 1; k + 1 < count; ++k)
            mesh.triangles.push_back({index(0), index(k), index(k + 1)});
        break;
    default:
        break; // points and lines have no surface
    }
}

/// What the levels of a file may hold together, vertices and triangles counted alike. Nodes, levels and
/// primitives may share what is in the file, so that a small one can name much: within reason.
class Budget {
  public:
    explicit Budget(std::size_t bytes) : left(100'000 + 8 * bytes) {}
    void take(std::size_t count) {
        if (count > left)
            refuse("makes more vertices and triangles of its bytes than is read: 100,000 and 8 a byte");
        left -= count;
    }

  private:
    std::size_t left;
};

class GlbReader {
  public:
    explicit GlbReader(const GltfFile& file) : file(file), model(file.model), budget(file.bytes) {}

    Level level(const std::vector<int>& nodes) {
        Level level;
        normals = true, colours = false;
        TextureReader texture(file);
        textures = &texture;
        copies = {};
        visited.assign(model.nodes.size(), false);
        add_nodes(level, nodes);
        if (!normals) level.mesh.normals.clear();
        if (!colours) level.mesh.colours.clear();
        level.wedges = copies.wedges(level.mesh);
        texture.finish(level);
        return level;
    }

  private:
    struct Placed {
        int node;
        glm::dmat4 parent;
    };

    /// Each before its children, and these in their order. No recursion: a file may nest as deep as it likes.
    void add_nodes(Level& level, const std::vector<int>& roots) {
        std::vector<Placed> waiting;
        const auto put = [&](const std::vector<int>& nodes, const glm::dmat4& parent) {
            for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) waiting.push_back({*node, parent});
        };
        put(roots, glm::dmat4(1));
        while (!waiting.empty()) {
            const Placed next = waiting.back();
            waiting.pop_back();
            const tinygltf::Node& node = at(model.nodes, next.node, "a node");
            if (visited[std::size_t(next.node)]) refuse("its nodes are no tree");
            visited[std::size_t(next.node)] = true;
            const glm::dmat4 m = next.parent * transform_of(node);
            if (node.mesh >= 0) add_mesh(level, at(model.meshes, node.mesh, "a mesh"), m);
            put(node.children, m);
        }
    }

    void add_mesh(Level& level, const tinygltf::Mesh& mesh, const glm::dmat4& m) {
        if (level.name.empty()) level.name = mesh.name;
        read_extras(mesh.extras, level);
        const std::size_t first = level.mesh.positions.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives) add_primitive(level.mesh, primitive, m);
        join_copies(level.mesh, first, mesh.extras);
    }

    /// Where the file is as we wrote it: `seams` of one primitive, `vertices` of several.
    void join_copies(Mesh& mesh, std::size_t first, const Value& extras) {
        Copies copies;
        if (const auto seams = numbers(extras, "seams", mesh); seams && seams->size() < mesh.positions.size())
            copies = copies_at_end(mesh, *seams);
        else if (auto vertices = numbers(extras, "vertices", mesh); vertices && !vertices->empty()) {
            copies.count = std::size_t(*std::max_element(vertices->begin(), vertices->end())) + 1;
            copies.first = first, copies.of = std::move(*vertices);
            if (copies.count > copies.of.size()) return;
        }
        if (are_copies(mesh, copies)) this->copies.join(mesh, copies);
    }

    /// Of the accessor that `extras` names, no more than there are vertices.
    std::optional<std::vector<std::uint32_t>> numbers(const Value& extras, const char* name,
                                                      const Mesh& mesh) const {
        const double accessor = number_in(extras, name, -1);
        if (!(accessor >= 0 && accessor < double(model.accessors.size()))) return {};
        const Elements elements(model, int(accessor));
        if (elements.count() > mesh.positions.size()) return {};
        std::vector<std::uint32_t> found;
        for (std::size_t k = 0; k < elements.count(); ++k)
            found.push_back(std::uint32_t(std::clamp(elements.get(k, 0), 0.0, double(UINT32_MAX))));
        return found;
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
        budget.take(positions.count());
        for (std::size_t v = 0; v < positions.count(); ++v)
            mesh.positions.emplace_back(m * glm::dvec4(positions.vec3(v), 1));
        add_normals(mesh, accessor("NORMAL"), m);
        add_colours(mesh, accessor("COLOR_0"), primitive.material);
        if (primitive.indices < 0) {
            budget.take(triangle_count(primitive.mode, positions.count()));
            add_triangles(mesh, primitive.mode, positions.count(),
                          [&](std::size_t k) { return std::uint32_t(base + k); });
        } else {
            const Elements indices(model, primitive.indices);
            budget.take(triangle_count(primitive.mode, indices.count()));
            add_triangles(mesh, primitive.mode, indices.count(), [&](std::size_t k) {
                const double i = indices.get(k, 0);
                if (!(i >= 0 && i < double(positions.count())))
                    refuse("a face refers to a vertex that is not there");
                return static_cast<std::uint32_t>(base + std::size_t(i));
            });
        }
        if (glm::determinant(glm::dmat3(m)) < 0) // mirrored: what was outside stays so
            for (std::size_t t = first; t < mesh.triangles.size(); ++t)
                std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
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
        bool is_ours = false; // a plain white, which the format leaves out
        if (material >= 0) {
            const tinygltf::Material& described = at(model.materials, material, "a material");
            const auto& f = described.pbrMetallicRoughness.baseColorFactor;
            is_ours = described.name == material_name(glm::vec3(1));
            if (f.size() >= 3) factor = {f[0], f[1], f[2]};
        }
        colours =
            colours || accessor >= 0 || factor != glm::dvec3(1) || is_ours; // white beside others is a colour
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

    const GltfFile& file;
    const Model& model;
    Budget budget;
    std::vector<bool> visited;
    TextureReader* textures = nullptr; ///< of the level that is read
    CopyJoiner copies;                 ///< likewise
    bool normals = true;               ///< every primitive of the level has them
    bool colours = false;              ///< one has
};

/// The nodes that MSFT_lod puts behind the only node of the scene.
std::vector<int> further_levels(const Model& model, const std::vector<int>& shown) {
    std::vector<int> nodes;
    if (shown.size() != 1) return nodes;
    const auto& extensions = at(model.nodes, shown[0], "a node").extensions;
    const auto found = extensions.find("MSFT_lod");
    if (found == extensions.end() || !found->second.IsObject() || !found->second.Has("ids")) return nodes;
    const Value& ids = found->second.Get("ids");
    std::set<int> named(shown.begin(), shown.end());
    for (std::size_t k = 0; k < ids.ArrayLen(); ++k) {
        const Value& id = ids.Get(int(k));
        const double number = id.IsNumber() ? id.GetNumberAsDouble() : -1;
        if (!(number >= 0 && number < double(model.nodes.size())))
            refuse("refers to a node that is not there");
        nodes.push_back(int(number));
        if (!named.insert(nodes.back()).second) refuse("names a level twice");
    }
    return nodes;
}

/// The nodes of the scene that is to be shown: that which the file says, else the first, else all that are
/// nobody's children.
std::vector<int> shown_nodes(const Model& model) {
    if (!model.scenes.empty()) return at(model.scenes, std::max(model.defaultScene, 0), "a scene").nodes;
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (int child : node.children)
            if (child >= 0 && std::size_t(child) < is_child.size()) is_child[std::size_t(child)] = true;
    std::vector<int> roots;
    for (std::size_t k = 0; k < model.nodes.size(); ++k)
        if (!is_child[k]) roots.push_back(int(k));
    return roots;
}

} // namespace

std::vector<Level> read_glb(std::string_view bytes, const std::filesystem::path& path) {
    const GltfFile file = load_gltf(bytes, path);
    const std::vector<int> shown = shown_nodes(file.model);
    GlbReader reader(file);
    std::vector<Level> levels;
    levels.push_back(reader.level(shown));
    for (int node : further_levels(file.model, shown)) levels.push_back(reader.level({node}));
    for (std::size_t k = 0; k < levels.size(); ++k)
        if (levels[k].name.empty()) levels[k].name = "level " + std::to_string(k);
    return levels;
}

} // namespace glcast::format
