// .glb by tinygltf: one buffer; a mesh and a node per level; the scene shows level 0, MSFT_lod names the
// others.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <sstream>
#include <tiny_gltf.h>

#include "tools/io/mesh_format.h"

namespace glcast::format {
namespace {

using tinygltf::Value;

constexpr std::size_t largest_glb = 0xffff0000; // its lengths are 32 bits; some room for the JSON

class GlbBuilder {
  public:
    GlbBuilder() {
        model.asset.version = "2.0";
        model.asset.generator = "glcast " GLCAST_VERSION;
        model.buffers.resize(1);
        tinygltf::Material material;
        material.name = "as drawn";
        material.pbrMetallicRoughness.metallicFactor = 0;
        material.pbrMetallicRoughness.roughnessFactor = 0.8;
        model.materials.push_back(material);
    }

    void add_level(const Level& level, const glm::dvec3& origin);
    void add_scene(std::span<const Level> levels);
    tinygltf::Model model;

  private:
    template <class T> int add_view(const std::vector<T>& data, int target);
    int add_accessor(int view, int type, int component, std::size_t count, bool normalized = false);
    int add_positions(const Mesh& mesh, const glm::dvec3& origin);
    int add_normals(const Mesh& mesh);
    int add_colours(const Mesh& mesh);
    int add_indices(const Mesh& mesh);
};

template <class T> int GlbBuilder::add_view(const std::vector<T>& data, int target) {
    std::vector<unsigned char>& bytes = model.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = data.size() * sizeof(T);
    view.target = target;
    if (bytes.size() + view.byteLength > largest_glb)
        refuse("the mesh is too large for .glb (4 GB); write .ply");
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, data.data(), view.byteLength);
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
}

int GlbBuilder::add_accessor(int view, int type, int component, std::size_t count, bool normalized) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.type = type;
    accessor.componentType = component;
    accessor.count = count;
    accessor.normalized = normalized;
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

int GlbBuilder::add_positions(const Mesh& mesh, const glm::dvec3& origin) {
    std::vector<glm::vec3> data;
    data.reserve(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) data.emplace_back(p - origin);
    glm::vec3 lo = data.at(0), hi = lo;
    for (const glm::vec3& p : data) lo = glm::min(lo, p), hi = glm::max(hi, p);
    const int accessor = add_accessor(add_view(data, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_TYPE_VEC3,
                                      TINYGLTF_COMPONENT_TYPE_FLOAT, data.size());
    model.accessors[accessor].minValues = {lo.x, lo.y, lo.z};
    model.accessors[accessor].maxValues = {hi.x, hi.y, hi.z};
    return accessor;
}

int GlbBuilder::add_normals(const Mesh& mesh) {
    return add_accessor(add_view(mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_TYPE_VEC3,
                        TINYGLTF_COMPONENT_TYPE_FLOAT, mesh.normals.size());
}

/// COLOR_0 is linear light in glTF, what the program drew is for display; 16 bits keep dark tones apart.
int GlbBuilder::add_colours(const Mesh& mesh) {
    std::vector<std::uint16_t> data;
    data.reserve(mesh.colours.size() * 4);
    for (const glm::vec3& c : mesh.colours) {
        for (int k = 0; k < 3; ++k)
            data.push_back(static_cast<std::uint16_t>(std::lround(to_linear(c[k]) * 65535.0f)));
        data.push_back(65535);
    }
    return add_accessor(add_view(data, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_TYPE_VEC4,
                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, mesh.colours.size(), true);
}

int GlbBuilder::add_indices(const Mesh& mesh) {
    const std::size_t count = mesh.triangles.size() * 3;
    if (mesh.positions.size() > 65535)
        return add_accessor(add_view(mesh.triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                            TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, count);
    std::vector<std::uint16_t> data;
    data.reserve(count);
    for (const Triangle& t : mesh.triangles) data.insert(data.end(), t.begin(), t.end());
    return add_accessor(add_view(data, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_TYPE_SCALAR,
                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, count);
}

void GlbBuilder::add_level(const Level& level, const glm::dvec3& origin) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    primitive.attributes["POSITION"] = add_positions(level.mesh, origin);
    if (!level.mesh.normals.empty()) primitive.attributes["NORMAL"] = add_normals(level.mesh);
    if (!level.mesh.colours.empty()) primitive.attributes["COLOR_0"] = add_colours(level.mesh);
    primitive.indices = add_indices(level.mesh);
    tinygltf::Mesh mesh;
    mesh.name = level.name;
    mesh.primitives.push_back(primitive);
    mesh.extras = Value(Value::Object{{"triangles", Value(static_cast<int>(level.mesh.triangles.size()))},
                                      {"meanError", Value(level.error.mean)},
                                      {"maxError", Value(level.error.max)},
                                      {"sample", Value(level.sample)}});
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = level.name;
    node.mesh = static_cast<int>(model.meshes.size()) - 1;
    if (origin != glm::dvec3(0)) node.translation = {origin.x, origin.y, origin.z};
    model.nodes.push_back(node);
}

/// A level gives way to the next where that one, drawn so small, has triangles as small on the screen as
/// level 0's.
void GlbBuilder::add_scene(std::span<const Level> levels) {
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    if (levels.size() < 2) return;
    Value::Array ids, coverage;
    for (std::size_t k = 1; k < levels.size(); ++k) {
        ids.push_back(Value(static_cast<int>(k)));
        const double share =
            double(levels[k].mesh.triangles.size()) / double(levels[0].mesh.triangles.size());
        coverage.push_back(Value(std::sqrt(std::min(share, 1.0))));
    }
    coverage.push_back(Value(0.0));
    model.nodes[0].extensions["MSFT_lod"] = Value(Value::Object{{"ids", Value(ids)}});
    model.nodes[0].extras = Value(Value::Object{{"MSFT_screencoverage", Value(coverage)}});
    model.extensionsUsed.push_back("MSFT_lod");
}

} // namespace

std::string glb_bytes(std::span<const Level> levels) {
    // Positions are floats: far from the origin they are kept relative to a whole-numbered point near the
    // mesh.
    const bool far = needs_doubles(levels[0].mesh);
    const glm::dvec3 origin = far ? glm::round(centre(levels[0].mesh)) : glm::dvec3(0);
    GlbBuilder builder;
    for (const Level& level : levels) builder.add_level(level, origin);
    builder.add_scene(levels);
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&builder.model, stream, false, true))
        refuse("tinygltf cannot write it");
    return std::move(stream).str();
}

bool write_glb(OutputFile& file, std::span<const Level> levels) {
    const std::string bytes = glb_bytes(levels);
    return file.append(bytes.data(), bytes.size());
}

} // namespace glcast::format
