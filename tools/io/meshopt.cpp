#include "tools/io/meshopt.h"

#include <cstring>
#include <meshoptimizer.h>

#include "tools/io/mesh_format.h"

namespace glcast::format {
namespace {

using Json = nlohmann::ordered_json;

constexpr int vertex_target = 34962, index_target = 34963;
/// The codecs' best: of sixteen equal bytes of neighbouring vertices two bits are left.
constexpr std::size_t best_ratio = 64;

enum class Mode { attributes, triangles, indices };
struct ModeName {
    Mode mode;
    const char* name;
};
constexpr ModeName modes[] = {
    {Mode::attributes, "ATTRIBUTES"}, {Mode::triangles, "TRIANGLES"}, {Mode::indices, "INDICES"}};

using Filter = void (*)(void*, std::size_t, std::size_t);
struct FilterName {
    const char* name;
    Filter decode;
    std::size_t strides[2]; ///< that it takes; 0: any multiple of four
};
constexpr FilterName filters[] = {{"NONE", nullptr, {0, 0}},
                                  {"OCTAHEDRAL", meshopt_decodeFilterOct, {4, 8}},
                                  {"QUATERNION", meshopt_decodeFilterQuat, {8, 8}},
                                  {"EXPONENTIAL", meshopt_decodeFilterExp, {0, 0}}};

std::size_t size_in(const Json& object, const char* name, std::size_t otherwise = 0) {
    const auto found = object.find(name);
    if (found == object.end()) return otherwise;
    if (!found->is_number_unsigned()) refuse(std::string("is damaged: ") + name + " is no length");
    return found->get<std::size_t>();
}

using Buffers = std::vector<std::string_view>;

/// Of its buffer what a view says.
std::string_view part(const Buffers& buffers, const Json& view) {
    const std::size_t offset = size_in(view, "byteOffset"), length = size_in(view, "byteLength"),
                      buffer = size_in(view, "buffer");
    if (buffer >= buffers.size()) refuse("refers to a buffer that is not there");
    const std::string_view bytes = buffers[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset)
        refuse("has a buffer view beyond its buffer");
    return bytes.substr(offset, length);
}

void align(std::string& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4); }

std::vector<std::uint32_t> wide_indices(std::string_view data, std::size_t stride) {
    std::vector<std::uint32_t> indices(data.size() / stride);
    for (std::size_t k = 0; k < indices.size(); ++k)
        std::memcpy(&indices[k], data.data() + k * stride, stride);
    return indices;
}

using Codes = std::vector<unsigned char>;

Codes encoded_vertices(std::string_view data, std::size_t count, std::size_t stride) {
    Codes codes(meshopt_encodeVertexBufferBound(count, stride));
    codes.resize(meshopt_encodeVertexBuffer(codes.data(), codes.size(), data.data(), count, stride));
    return codes;
}

Codes encoded_indices(std::string_view data, Mode mode, std::size_t stride) {
    const std::vector<std::uint32_t> indices = wide_indices(data, stride);
    std::size_t vertices = 0;
    for (const std::uint32_t v : indices) vertices = std::max<std::size_t>(vertices, std::size_t(v) + 1);
    meshopt_encodeIndexVersion(1);
    const std::size_t count = indices.size();
    Codes codes;
    if (mode == Mode::triangles) {
        codes.resize(meshopt_encodeIndexBufferBound(count, vertices));
        codes.resize(meshopt_encodeIndexBuffer(codes.data(), codes.size(), indices.data(), count));
    } else {
        codes.resize(meshopt_encodeIndexSequenceBound(count, vertices));
        codes.resize(meshopt_encodeIndexSequence(codes.data(), codes.size(), indices.data(), count));
    }
    return codes;
}

/// How to compress a view: nothing where it is a picture.
struct Plan {
    Mode mode = Mode::attributes;
    std::size_t count = 0, stride = 0;
};

std::vector<Plan> plans(const Json& gltf) {
    std::vector<Plan> all(gltf.at("bufferViews").size());
    for (const Json& accessor : gltf.at("accessors")) {
        const std::size_t at = size_in(accessor, "bufferView");
        const Json& view = gltf.at("bufferViews").at(at);
        const int target = view.value("target", 0);
        const bool wide = accessor.at("componentType") == 5125;
        all[at] = {target == vertex_target  ? Mode::attributes
                   : target == index_target ? Mode::triangles
                                            : Mode::indices,
                   size_in(accessor, "count"), size_in(view, "byteStride", wide ? 4 : 2)};
    }
    return all;
}

/// The names of extensions less one.
void drop_name(Json& gltf, const char* list, const char* name) {
    if (!gltf.contains(list)) return;
    Json left = Json::array();
    for (const Json& item : gltf[list])
        if (item != name) left.push_back(item);
    if (left.empty())
        gltf.erase(list);
    else
        gltf[list] = left;
}

const char* name_of(Mode mode) { return modes[int(mode)].name; }

Mode mode_of(const std::string& name) {
    for (const ModeName& m : modes)
        if (name == m.name) return m.mode;
    refuse("is damaged: meshopt compression of an unknown mode");
}

const FilterName& filter_of(const std::string& name) {
    for (const FilterName& f : filters)
        if (name == f.name) return f;
    refuse("is damaged: meshopt compression with an unknown filter");
}

bool fits(Mode mode, const FilterName& filter, std::size_t count, std::size_t stride) {
    if (mode != Mode::attributes)
        return (stride == 2 || stride == 4) && !filter.decode && (mode == Mode::indices || count % 3 == 0);
    if (stride == 0 || stride > 256 || stride % 4 != 0) return false;
    return filter.strides[0] == 0 || stride == filter.strides[0] || stride == filter.strides[1];
}

std::string decoded(std::string_view codes, const Json& how) {
    const std::size_t count = size_in(how, "count"), stride = size_in(how, "byteStride");
    const Mode mode = mode_of(how.value("mode", ""));
    const FilterName& filter = filter_of(how.value("filter", "NONE"));
    if (!fits(mode, filter, count, stride)) refuse("is damaged: meshopt compression of odd sizes");
    if (count > (codes.size() * best_ratio + 65536) / stride)
        refuse("is damaged: more vertices than its bytes can hold");
    std::string data(count * stride, '\0');
    const auto* from = reinterpret_cast<const unsigned char*>(codes.data());
    int failed = 0;
    switch (mode) {
    case Mode::attributes:
        failed = meshopt_decodeVertexBuffer(data.data(), count, stride, from, codes.size());
        break;
    case Mode::triangles:
        failed = meshopt_decodeIndexBuffer(data.data(), count, stride, from, codes.size());
        break;
    case Mode::indices:
        failed = meshopt_decodeIndexSequence(data.data(), count, stride, from, codes.size());
        break;
    }
    if (failed) refuse("is damaged: its compressed data does not unpack");
    if (filter.decode) filter.decode(data.data(), count, stride);
    return data;
}

} // namespace

Mesh reorder_for_drawing(const Mesh& mesh, CornerSplit& split, std::vector<std::uint32_t>* order_of_mesh) {
    const std::size_t own = mesh.positions.size(), all = split.vertices(mesh);
    auto* corners = split.triangles.data()->data();
    meshopt_optimizeVertexCache(corners, corners, split.triangles.size() * 3, all);
    constexpr std::uint32_t unused = UINT32_MAX;
    std::vector<std::uint32_t> becomes(all, unused), order(all);
    std::size_t next = 0, next_copy = own;
    const auto place = [&](std::uint32_t v) {
        if (becomes[v] != unused) return;
        becomes[v] = std::uint32_t(v < own ? next++ : next_copy++);
        order[becomes[v]] = v;
    };
    for (const Triangle& t : split.triangles)
        for (const std::uint32_t v : t) place(v);
    for (std::size_t v = 0; v < all; ++v) place(std::uint32_t(v));

    for (Triangle& t : split.triangles)
        for (std::uint32_t& v : t) v = becomes[v];
    const CornerSplit before = split;
    for (std::size_t v = own; v < all; ++v)
        split.originals[v - own] = becomes[before.originals[order[v] - own]];
    const auto move = [&](auto& values, const auto& from) {
        for (std::size_t v = 0; v < values.size(); ++v) values[v] = from[order[v]];
    };
    move(split.normals, before.normals), move(split.colours, before.colours);
    move(split.coordinates, before.coordinates), move(split.tangents, before.tangents);
    Mesh moved;
    for (std::size_t v = 0; v < own; ++v) {
        moved.positions.push_back(mesh.positions[order[v]]);
        if (!mesh.normals.empty()) moved.normals.push_back(mesh.normals[order[v]]);
        if (!mesh.colours.empty()) moved.colours.push_back(mesh.colours[order[v]]);
    }
    if (order_of_mesh) order_of_mesh->assign(order.begin(), order.begin() + std::ptrdiff_t(own));
    return moved;
}

std::string meshopt_compressed(std::string_view file) {
    GlbChunks chunks = glb_chunks(file);
    Json& gltf = chunks.json;
    const std::vector<Plan> planned = plans(gltf);
    std::string bytes;
    std::size_t whole = 0; // of the buffer that there would be without compression
    for (std::size_t k = 0; k < planned.size(); ++k) {
        Json& view = gltf["bufferViews"][k];
        const std::string_view data = part({chunks.bytes}, view);
        align(bytes);
        if (planned[k].count == 0) {
            view["byteOffset"] = bytes.size();
            bytes += data;
            continue;
        }
        const auto [mode, count, stride] = planned[k];
        const Codes codes = mode == Mode::attributes ? encoded_vertices(data, count, stride)
                                                     : encoded_indices(data, mode, stride);
        view["extensions"][meshopt_extension] = {{"buffer", 0},
                                                 {"byteOffset", bytes.size()},
                                                 {"byteLength", codes.size()},
                                                 {"byteStride", stride},
                                                 {"count", count},
                                                 {"mode", name_of(mode)}};
        bytes.append(reinterpret_cast<const char*>(codes.data()), codes.size());
        view["buffer"] = 1;
        view["byteOffset"] = whole;
        view["byteLength"] = count * stride;
        whole = (whole + count * stride + 3) / 4 * 4;
    }
    align(bytes);
    gltf["buffers"] =
        Json::array({{{"byteLength", bytes.size()}},
                     {{"byteLength", whole}, {"extensions", {{meshopt_extension, {{"fallback", true}}}}}}});
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) gltf[list].push_back(meshopt_extension);
    return glb_file(gltf, bytes);
}

std::string meshopt_decompressed(Json& gltf, const Buffers& buffers) try {
    std::size_t most = 65536; // what all of it may become: views may share their bytes
    for (const std::string_view buffer : buffers) most += best_ratio * buffer.size();
    std::string bytes;
    for (Json& view : gltf.at("bufferViews")) {
        align(bytes);
        const std::size_t offset = bytes.size();
        if (view.contains("extensions") && view["extensions"].contains(meshopt_extension)) {
            const Json how = view["extensions"][meshopt_extension];
            bytes += decoded(part(buffers, how), how);
            view.erase("extensions");
        } else
            bytes += part(buffers, view);
        if (bytes.size() > most) refuse("is damaged: more vertices than its bytes can hold");
        view["buffer"] = 0;
        view["byteOffset"] = offset;
        view["byteLength"] = bytes.size() - offset;
    }
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        drop_name(gltf, list, meshopt_extension);
    return bytes;
} catch (const Json::exception&) {
    refuse("is damaged: its compression is not described as it must be");
}

} // namespace glcast::format
