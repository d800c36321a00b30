#include "tools/io/gltf_file.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <set>

#include "tools/io/beside.h"
#include "tools/io/glb_accessor.h"
#include "tools/io/glb_container.h"
#include "tools/io/meshopt.h"

namespace glcast::format {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_buffers = 1000; // of other programs: one or two
constexpr std::size_t largest_beside = std::size_t(4) << 30;

/// "a%20b" -> "a b"
std::string without_escapes(std::string_view uri) {
    std::string name;
    for (std::size_t k = 0; k < uri.size(); ++k) {
        unsigned char byte = 0;
        const bool escaped = uri[k] == '%' && k + 2 < uri.size() &&
                             std::from_chars(&uri[k + 1], &uri[k + 1] + 2, byte, 16).ptr == &uri[k + 1] + 2;
        name += escaped ? char(byte) : uri[k];
        if (escaped) k += 2;
    }
    return name;
}

std::string from_data_uri(const std::string& uri) {
    std::vector<unsigned char> bytes;
    std::string kind;
    if (!tinygltf::DecodeDataURI(&bytes, kind, uri, 0, false)) refuse("has a data URI that cannot be read");
    return {bytes.begin(), bytes.end()};
}

std::string from_uri(const std::string& uri, const std::filesystem::path& path) {
    if (tinygltf::IsDataURI(uri)) return from_data_uri(uri);
    auto bytes = read_beside(path, without_escapes(uri), largest_beside);
    if (!bytes) refuse("names a file that is not in its folder: " + uri);
    return std::move(*bytes);
}

/// The buffers of a file, each its stated length.
class Buffers {
  public:
    Buffers(const GlbChunks& chunks, const std::filesystem::path& path) {
        const auto list = chunks.json.find("buffers");
        if (list == chunks.json.end()) return;
        if (!list->is_array() || list->size() > most_buffers) refuse("has too many buffers");
        for (const Json& buffer : *list) add(buffer, chunks.bytes, path);
    }
    const std::vector<std::string_view>& views() const { return all; }

  private:
    void add(const Json& buffer, std::string_view own, const std::filesystem::path& path) {
        if (!buffer.is_object() || !buffer.contains("byteLength") ||
            !buffer["byteLength"].is_number_unsigned())
            refuse("is damaged: a buffer has no length");
        const std::size_t length = buffer["byteLength"].get<std::size_t>();
        std::string_view bytes;
        if (buffer.contains("uri")) {
            if (!buffer["uri"].is_string()) refuse("is damaged: a buffer's URI is no text");
            const std::string uri = buffer["uri"].get<std::string>();
            if (!names.insert(uri).second) refuse("names a file for two buffers: " + uri.substr(0, 80));
            bytes = read.emplace_back(from_uri(uri, path));
        } else if (all.empty()) {
            bytes = own;
        } else if (is_fallback(buffer)) {
            all.emplace_back(); // there are no bytes of it, nor need there be
            return;
        }
        if (length == 0 || length > bytes.size()) refuse("has a buffer beyond its bytes");
        all.push_back(bytes.substr(0, length));
    }
    static bool is_fallback(const Json& buffer) {
        return buffer.contains("extensions") && buffer["extensions"].contains(meshopt_extension);
    }

    std::deque<std::string> read;
    std::set<std::string> names;
    std::vector<std::string_view> all;
};

/// A buffer is named by its number when tinygltf asks for it, and an image not at all.
void name_by_numbers(Json& gltf, const std::vector<std::string_view>& buffers) {
    gltf["buffers"] = Json::array();
    for (std::size_t k = 0; k < buffers.size(); ++k)
        gltf["buffers"].push_back({{"byteLength", buffers[k].size()}, {"uri", std::to_string(k)}});
    if (buffers.empty()) gltf.erase("buffers");
}

std::vector<std::string> take_picture_names(Json& gltf) {
    std::vector<std::string> names;
    const auto images = gltf.find("images");
    if (images == gltf.end() || !images->is_array()) return names;
    for (Json& image : *images) {
        names.emplace_back();
        if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) continue;
        names.back() = image["uri"].get<std::string>();
        image["uri"] = "none";
    }
    return names;
}

// tinygltf's way to files: there are none but the buffers.

const std::string_view* buffer_named(const std::string& name, void* buffers) {
    const auto& all = *static_cast<const std::vector<std::string_view>*>(buffers);
    std::size_t number = all.size();
    const char* end = name.data() + name.size();
    if (std::from_chars(name.data(), end, number).ptr != end || number >= all.size()) return nullptr;
    return &all[number];
}
bool exists(const std::string& name, void* buffers) { return buffer_named(name, buffers); }
std::string as_it_is(const std::string& name, void*) { return name; }
bool read_whole(std::vector<unsigned char>* to, std::string*, const std::string& name, void* buffers) {
    const std::string_view* from = buffer_named(name, buffers);
    if (from) to->assign(from->begin(), from->end());
    return from;
}
bool write_none(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

/// Pictures are decoded when a level turns out to need them.
bool no_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return true;
}

/// Extensions that a reader of surfaces and colours may leave alone where they are required.
bool may_be_left_alone(const std::string& extension) {
    return extension == "KHR_mesh_quantization" || extension == "KHR_texture_transform" ||
           extension == "KHR_lights_punctual" || extension.starts_with("KHR_materials_");
}

tinygltf::Model parsed(Json& gltf, std::vector<std::string_view> buffers) {
    name_by_numbers(gltf, buffers);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(no_image, nullptr);
    loader.SetFsCallbacks({exists, as_it_is, read_whole, write_none, &buffers});
    tinygltf::Model model;
    std::string error, warning;
    const std::string text = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > UINT32_MAX || !loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                                static_cast<unsigned>(text.size()), ""))
        refuse("is damaged or no glTF 2.0: " + error.substr(0, error.find('\n')));
    for (const std::string& extension : model.extensionsRequired)
        if (!may_be_left_alone(extension)) refuse("needs the extension " + extension + ", which is not read");
    for (const tinygltf::Node& node : model.nodes)
        if (node.extensions.contains("EXT_mesh_gpu_instancing"))
            refuse("has instances by EXT_mesh_gpu_instancing, which are not read");
    return model;
}

bool is_compressed(const Json& gltf) {
    const auto used = gltf.find("extensionsUsed");
    return used != gltf.end() && used->is_array() &&
           std::ranges::find(*used, meshopt_extension) != used->end();
}

} // namespace

GltfFile load_gltf(std::string_view bytes, const std::filesystem::path& path) {
    const bool is_text = path.extension() == ".gltf" && !bytes.starts_with("glTF");
    GlbChunks chunks = is_text ? GlbChunks{gltf_json(bytes), {}} : glb_chunks(bytes);
    GltfFile file;
    file.path = path;
    file.picture_names = take_picture_names(chunks.json);
    const Buffers buffers(chunks, path);
    file.bytes = bytes.size();
    for (const std::string_view buffer : buffers.views()) file.bytes += buffer.size();
    if (is_compressed(chunks.json)) {
        const std::string unpacked = meshopt_decompressed(chunks.json, buffers.views());
        file.model = parsed(chunks.json, {unpacked});
    } else {
        file.model = parsed(chunks.json, buffers.views());
    }
    return file;
}

std::string picture_bytes(const GltfFile& file, int index) {
    const tinygltf::Image& image = at(file.model.images, index, "an image");
    if (image.bufferView < 0) {
        const std::string& name = at(file.picture_names, index, "an image");
        if (name.empty()) return {};
        return from_uri(name, file.path);
    }
    const auto& view = at(file.model.bufferViews, image.bufferView, "a buffer view");
    const auto& data = at(file.model.buffers, view.buffer, "a buffer").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        refuse("has a picture beyond its buffer");
    const auto* from = reinterpret_cast<const char*>(data.data()) + view.byteOffset;
    return {from, view.byteLength};
}

} // namespace glcast::format
