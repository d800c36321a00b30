// .glb by tinygltf: one buffer; a mesh and a node per level; the scene shows level 0, MSFT_lod names the
// others.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <streambuf>
#include <tiny_gltf.h>

#include "tools/io/glb_container.h"
#include "tools/io/glb_extras.h"
#include "tools/io/mesh_format.h"
#include "tools/io/meshopt.h"
#include "tools/mesh/corner_split.h"
#include "tools/mesh/face_colours.h"
#include "tools/picture/png.h"

namespace glcast::format {
namespace {

using tinygltf::Value;

constexpr std::size_t largest_glb = 0xffff0000; // its lengths are 32 bits; some room for the JSON
constexpr int no_target = 0;

/// The pictures of a textured level, as PNG.
struct Pngs {
    std::string colour, normal;
};

/// Most of the time that a textured file takes: on all cores.
std::vector<Pngs> make_pngs(std::span<const Level> levels) {
    std::vector<Pngs> pngs(levels.size());
    tbb::parallel_for(std::size_t(0), levels.size() * 2, [&](std::size_t i) {
        const Level& level = levels[i / 2];
        if (level.texture.empty()) return;
        (i % 2 ? pngs[i / 2].normal : pngs[i / 2].colour) =
            png_bytes(i % 2 ? level.texture.normal : level.texture.colour);
    });
    return pngs;
}

class GlbBuilder {
  public:
    /// Positions are floats relative to `origin`, or with a grid whole steps on it, and all else smaller too.
    GlbBuilder(const glm::dvec3& origin, const std::optional<PositionGrid>& grid, bool reorder)
        : origin(origin), grid(grid), reorder(reorder) {
        model.asset.version = "2.0";
        model.asset.generator = "glcast " GLCAST_VERSION;
        model.buffers.resize(1);
        if (grid) {
            model.extensionsUsed.push_back("KHR_mesh_quantization");
            model.extensionsRequired.push_back("KHR_mesh_quantization");
        }
    }

    /// Room for the levels, so that the buffer need not grow, and be copied, on the way.
    void reserve(std::span<const Level> levels, const std::vector<Pngs>& pngs);
    void add_level(const Level& level, const Pngs& pngs);
    void add_scene(std::span<const Level> levels);
    tinygltf::Model model;

  private:
    int add_view(const void* data, std::size_t bytes, int target, std::size_t stride = 0);
    template <class T> int add_view(const std::vector<T>& data, int target, std::size_t stride = 0) {
        return add_view(data.data(), data.size() * sizeof(T), target, stride);
    }
    int add_accessor(int view, int type, int component, std::size_t count, bool normalized = false);
    template <class T>
    int add_attribute(const std::vector<T>& data, int type, int component, bool normalized = false) {
        return add_accessor(add_view(data, TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(T)), type, component,
                            data.size(), normalized);
    }
    void add_bounds(int accessor, const glm::dvec3& lo, const glm::dvec3& hi);
    int add_positions(const Mesh& mesh, const CornerSplit& split);
    int add_normals(const Mesh& mesh, const CornerSplit& split);
    int add_colours(const Mesh& mesh, const CornerSplit& split);
    int add_coordinates(const CornerSplit& split);
    int add_tangents(const CornerSplit& split);
    int add_indices(std::span<const std::uint32_t> indices, std::size_t vertices, int target);
    int add_image(const std::string& png, const std::string& name);
    int plain_material();
    int coloured_material(const glm::vec3& colour);
    int textured_material(const std::string& name, const Pngs& pngs);
    tinygltf::Primitive primitive_of(const Mesh& mesh, const CornerSplit& split);
    void add_whole(const Level& level, const FaceColours& colours, const Pngs& pngs, tinygltf::Mesh& mesh);
    void add_parts(const Level& level, const FaceColours& colours, tinygltf::Mesh& mesh);

    glm::dvec3 origin;
    std::optional<PositionGrid> grid;
    bool reorder;
    int plain = -1;
    std::map<std::array<float, 3>, int> coloured; ///< materials by their colours
};

void GlbBuilder::reserve(std::span<const Level> levels, const std::vector<Pngs>& pngs) {
    constexpr std::size_t vertex_bytes = 12 + 12 + 24, triangle_bytes = 12,
                          others = 4096; // seams come on top
    std::size_t bytes = others;
    for (std::size_t k = 0; k < levels.size(); ++k)
        bytes += levels[k].mesh.positions.size() * vertex_bytes +
                 levels[k].mesh.triangles.size() * triangle_bytes + pngs[k].colour.size() +
                 pngs[k].normal.size();
    model.buffers[0].data.reserve(std::min(bytes, largest_glb));
}

int GlbBuilder::add_view(const void* data, std::size_t size, int target, std::size_t stride) {
    std::vector<unsigned char>& bytes = model.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = size;
    view.byteStride = stride;
    view.target = target;
    if (bytes.size() + size > largest_glb) refuse("the mesh is too large for .glb (4 GB); write .ply");
    const auto* from = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), from, from + size);
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

void GlbBuilder::add_bounds(int accessor, const glm::dvec3& lo, const glm::dvec3& hi) {
    model.accessors[accessor].minValues = {lo.x, lo.y, lo.z};
    model.accessors[accessor].maxValues = {hi.x, hi.y, hi.z};
}

int GlbBuilder::add_positions(const Mesh& mesh, const CornerSplit& split) {
    const std::size_t count = split.vertices(mesh);
    glm::dvec3 lo(INFINITY), hi(-INFINITY);
    int accessor;
    if (grid) {
        std::vector<std::array<std::uint16_t, 4>> data; // vertices begin on multiples of four bytes
        data.reserve(count);
        const std::vector<GridPoint> points = on_grid(mesh, *grid);
        for (std::size_t v = 0; v < count; ++v) {
            const GridPoint& p = points[split.original(mesh, v)];
            data.push_back({p[0], p[1], p[2], 0});
            lo = glm::min(lo, glm::dvec3(p[0], p[1], p[2])), hi = glm::max(hi, glm::dvec3(p[0], p[1], p[2]));
        }
        accessor = add_attribute(data, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    } else {
        std::vector<glm::vec3> data;
        data.reserve(count);
        for (std::size_t v = 0; v < count; ++v) {
            const glm::vec3& p = data.emplace_back(mesh.positions[split.original(mesh, v)] - origin);
            lo = glm::min(lo, glm::dvec3(p)), hi = glm::max(hi, glm::dvec3(p));
        }
        accessor = add_attribute(data, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    }
    add_bounds(accessor, lo, hi);
    return accessor;
}

int GlbBuilder::add_normals(const Mesh& mesh, const CornerSplit& split) {
    const std::size_t count = split.vertices(mesh);
    if (grid) {
        std::vector<std::array<std::int8_t, 4>> data;
        data.reserve(count);
        for (std::size_t v = 0; v < count; ++v) {
            const glm::vec3& n = split.normal(mesh, v);
            data.push_back({signed_byte(n.x), signed_byte(n.y), signed_byte(n.z), 0});
        }
        return add_attribute(data, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_BYTE, true);
    }
    std::vector<glm::vec3> data;
    data.reserve(count);
    for (std::size_t v = 0; v < count; ++v) data.push_back(split.normal(mesh, v));
    return add_attribute(data, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

/// COLOR_0 is linear light in glTF, what the program drew is for display; 16 bits keep dark tones apart.
int GlbBuilder::add_colours(const Mesh& mesh, const CornerSplit& split) {
    std::vector<std::array<std::uint16_t, 4>> data;
    data.reserve(split.vertices(mesh));
    for (std::size_t v = 0; v < split.vertices(mesh); ++v) {
        const glm::vec3& c = split.colour(mesh, v);
        const auto linear = [&](int k) {
            return unsigned_short(to_linear(grid ? display_byte(c[k]) : c[k]));
        };
        data.push_back({linear(0), linear(1), linear(2), 65535});
    }
    return add_attribute(data, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, true);
}

int GlbBuilder::add_coordinates(const CornerSplit& split) {
    if (!grid) return add_attribute(split.coordinates, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT);
    std::vector<std::array<std::uint16_t, 2>> data;
    data.reserve(split.coordinates.size());
    for (const glm::vec2& at : split.coordinates)
        data.push_back({unsigned_short(at.x), unsigned_short(at.y)});
    return add_attribute(data, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, true);
}

int GlbBuilder::add_tangents(const CornerSplit& split) {
    if (!grid) return add_attribute(split.tangents, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_FLOAT);
    std::vector<std::array<std::int8_t, 4>> data;
    data.reserve(split.tangents.size());
    for (const glm::vec4& tangent : split.tangents) data.push_back(tangent_bytes(tangent));
    return add_attribute(data, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_BYTE, true);
}

int GlbBuilder::add_indices(std::span<const std::uint32_t> indices, std::size_t vertices, int target) {
    if (vertices > 65535)
        return add_accessor(add_view(indices.data(), indices.size_bytes(), target), TINYGLTF_TYPE_SCALAR,
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, indices.size());
    const std::vector<std::uint16_t> data(indices.begin(), indices.end());
    return add_accessor(add_view(data, target), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                        indices.size());
}

int GlbBuilder::add_image(const std::string& png, const std::string& name) {
    tinygltf::Image image;
    image.name = name;
    image.mimeType = "image/png";
    image.bufferView = add_view(png.data(), png.size(), no_target);
    model.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = static_cast<int>(model.images.size()) - 1;
    texture.sampler = 0;
    if (model.samplers.empty()) {
        tinygltf::Sampler sampler;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        model.samplers.push_back(sampler);
    }
    model.textures.push_back(texture);
    return static_cast<int>(model.textures.size()) - 1;
}

tinygltf::Material matt(const std::string& name) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    return material;
}

int GlbBuilder::plain_material() {
    if (plain >= 0) return plain;
    model.materials.push_back(matt("as drawn"));
    return plain = static_cast<int>(model.materials.size()) - 1;
}

int GlbBuilder::textured_material(const std::string& name, const Pngs& pngs) {
    tinygltf::Material material = matt(name + " as drawn");
    material.pbrMetallicRoughness.baseColorTexture.index = add_image(pngs.colour, name + " colour");
    material.normalTexture.index = add_image(pngs.normal, name + " normal");
    model.materials.push_back(material);
    return static_cast<int>(model.materials.size()) - 1;
}

/// Of a plain colour, which no COLOR_0 stands beside: viewers would multiply the two.
int GlbBuilder::coloured_material(const glm::vec3& colour) {
    const auto [found, is_new] =
        coloured.try_emplace({colour.x, colour.y, colour.z}, int(model.materials.size()));
    if (!is_new) return found->second;
    tinygltf::Material material = matt(material_name(colour));
    material.pbrMetallicRoughness.baseColorFactor = {to_linear(colour.x), to_linear(colour.y),
                                                     to_linear(colour.z), 1};
    model.materials.push_back(material);
    return found->second;
}

/// Places, normals and triangles. `mesh`: the level's vertices, in whatever order the split is.
tinygltf::Primitive GlbBuilder::primitive_of(const Mesh& mesh, const CornerSplit& split) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_positions(mesh, split);
    if (!mesh.normals.empty() || !split.normals.empty())
        primitive.attributes["NORMAL"] = add_normals(mesh, split);
    const std::span<const std::uint32_t> indices(split.triangles.data()->data(), split.triangles.size() * 3);
    primitive.indices = add_indices(indices, split.vertices(mesh), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return primitive;
}

/// A texture hides the colours, and so does a material of one.
Wedges shown_wedges(const Level& level, bool with_colours) {
    Wedges wedges = level.wedges;
    if (!with_colours) wedges.colours.clear();
    if (wedges.normals.empty() && wedges.colours.empty()) wedges.corners.clear();
    return wedges;
}

/// `colours`: none, or one.
void GlbBuilder::add_whole(const Level& level, const FaceColours& colours, const Pngs& pngs,
                           tinygltf::Mesh& mesh) {
    const bool textured = !level.texture.empty(), by_vertex = !textured && colours.empty();
    CornerSplit split = split_corners(level.mesh, level.texture, shown_wedges(level, by_vertex));
    Mesh moved;
    if (reorder) moved = reorder_for_drawing(level.mesh, split);
    const Mesh& vertices = reorder ? moved : level.mesh;
    tinygltf::Primitive primitive = primitive_of(vertices, split);
    if (textured) {
        primitive.attributes["TEXCOORD_0"] = add_coordinates(split);
        primitive.attributes["TANGENT"] = add_tangents(split);
        primitive.material = textured_material(level.name, pngs);
    } else {
        if (by_vertex && has_colours(vertices, {{}, {}, split.colours}))
            primitive.attributes["COLOR_0"] = add_colours(vertices, split);
        primitive.material = by_vertex ? plain_material() : coloured_material(colours.palette[0]);
    }
    mesh.primitives.push_back(primitive);
    if (!split.originals.empty())
        mesh.extras.Get<Value::Object>()["seams"] =
            Value(add_indices(split.originals, level.mesh.positions.size(), no_target));
}

/// A primitive a colour, each with vertices of its own.
void GlbBuilder::add_parts(const Level& level, const FaceColours& colours, tinygltf::Mesh& mesh) {
    Level placed = level;
    if (grid) {
        const std::vector<GridPoint> points = on_grid(level.mesh, *grid);
        for (std::size_t v = 0; v < points.size(); ++v) placed.mesh.positions[v] = position(points[v], *grid);
    }
    std::vector<std::uint32_t> vertices; // of the level, for each of the file
    for (std::uint32_t which = 0; which < colours.palette.size(); ++which) {
        FacePart part = part_of_colour(placed, colours, which);
        CornerSplit split = split_corners(part.mesh, {}, part.wedges);
        std::vector<std::uint32_t> order(part.vertices.size());
        std::iota(order.begin(), order.end(), 0);
        if (reorder) part.mesh = reorder_for_drawing(part.mesh, split, &order);
        tinygltf::Primitive primitive = primitive_of(part.mesh, split);
        primitive.material = coloured_material(colours.palette[which]);
        mesh.primitives.push_back(primitive);
        for (std::size_t v = 0; v < split.vertices(part.mesh); ++v)
            vertices.push_back(part.vertices[order[split.original(part.mesh, v)]]);
    }
    mesh.extras.Get<Value::Object>()["vertices"] =
        Value(add_indices(vertices, level.mesh.positions.size(), no_target));
}

void GlbBuilder::add_level(const Level& level, const Pngs& pngs) {
    tinygltf::Mesh mesh;
    mesh.name = level.name;
    mesh.extras = level_extras(level);
    const FaceColours colours = face_colours(level);
    if (colours.palette.size() > 1)
        add_parts(level, colours, mesh);
    else
        add_whole(level, colours, pngs, mesh);
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = level.name;
    node.mesh = static_cast<int>(model.meshes.size()) - 1;
    if (grid) {
        node.translation = {grid->lo.x, grid->lo.y, grid->lo.z};
        node.scale = {grid->step, grid->step, grid->step};
    } else if (origin != glm::dvec3(0))
        node.translation = {origin.x, origin.y, origin.z};
    model.nodes.push_back(node);
}

void GlbBuilder::add_scene(std::span<const Level> levels) {
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    if (levels.size() < 2) return;
    Value::Array ids, coverage;
    for (std::size_t k = 1; k < levels.size(); ++k) ids.push_back(Value(static_cast<int>(k)));
    for (const double share : screen_coverage(levels)) coverage.push_back(Value(share));
    model.nodes[0].extensions["MSFT_lod"] = Value(Value::Object{{"ids", Value(ids)}});
    model.nodes[0].extras = Value(Value::Object{{"MSFT_screencoverage", Value(coverage)}});
    model.extensionsUsed.push_back("MSFT_lod");
}

/// Straight into a file, without a copy of it all in memory.
class FileBuffer : public std::streambuf {
  public:
    explicit FileBuffer(OutputFile& file) : file(file) {}

  private:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        return file.append(bytes, std::size_t(count)) ? count : 0;
    }
    int_type overflow(int_type byte) override {
        const char one = traits_type::to_char_type(byte);
        return file.append(&one, 1) ? byte : traits_type::eof();
    }
    OutputFile& file;
};

/// tinygltf copies the buffer before it writes it: so it makes the JSON alone.
bool write_model(std::ostream& stream, tinygltf::Model&& model) {
    const std::vector<unsigned char> bytes = std::move(model.buffers[0].data);
    model.buffers[0].data.clear();
    std::ostringstream without;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, without, false, true)) return false;
    nlohmann::ordered_json json = glb_chunks(without.view()).json;
    json["buffers"][0]["byteLength"] = bytes.size();
    stream << glb_head(json, bytes.size());
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    for (std::size_t k = glb_padding(bytes.size()); k > 0; --k) stream.put('\0');
    return stream.good();
}

/// Uncompressed; false when the stream does not take it.
bool write_to(std::ostream& stream, std::span<const Level> levels, Compression compression,
              const PositionGrid* grid) {
    std::optional<PositionGrid> steps;
    if (compression != Compression::none) steps = grid ? *grid : grid_for(levels);
    // Positions are floats: far from the origin they are kept relative to a whole-numbered point near the
    // mesh.
    const bool far = !steps && needs_doubles(levels[0].mesh);
    const glm::dvec3 origin = far ? glm::round(centre(levels[0].mesh)) : glm::dvec3(0);
    GlbBuilder builder(origin, steps, compression == Compression::meshopt);
    const std::vector<Pngs> pngs = make_pngs(levels);
    builder.reserve(levels, pngs);
    for (std::size_t k = 0; k < levels.size(); ++k) builder.add_level(levels[k], pngs[k]);
    builder.add_scene(levels);
    return write_model(stream, std::move(builder.model));
}

} // namespace

std::string glb_bytes(std::span<const Level> levels, Compression compression, const PositionGrid* grid) {
    std::ostringstream stream;
    if (!write_to(stream, levels, compression, grid)) refuse("tinygltf cannot write it");
    std::string bytes = std::move(stream).str();
    return compression == Compression::meshopt ? meshopt_compressed(bytes) : bytes;
}

bool write_glb(OutputFile& file, std::span<const Level> levels, Compression compression,
               const PositionGrid* grid) {
    if (compression == Compression::meshopt) {
        const std::string bytes = glb_bytes(levels, compression, grid);
        return file.append(bytes.data(), bytes.size());
    }
    FileBuffer buffer(file);
    std::ostream stream(&buffer);
    if (write_to(stream, levels, compression, grid)) return true;
    if (file.error().empty()) refuse("tinygltf cannot write it");
    return false;
}

} // namespace glcast::format
