#include "tools/io/glb_container.h"

#include <cstdint>
#include <cstring>

#include "tools/io/mesh_format.h"

namespace glcast::format {
namespace {

constexpr std::uint32_t json_kind = 0x4e4f534a, bytes_kind = 0x004e4942; // "JSON", "BIN"

std::uint32_t word(std::string_view file, std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, file.data() + at, sizeof value);
    return value;
}

void add_word(std::string& file, std::uint32_t value) {
    file.append(reinterpret_cast<const char*>(&value), 4);
}

void add_chunk(std::string& file, std::uint32_t kind, std::string_view data, char filler) {
    const std::size_t padding = (4 - data.size() % 4) % 4;
    add_word(file, std::uint32_t(data.size() + padding));
    add_word(file, kind);
    file.append(data).append(padding, filler);
}

} // namespace

GlbChunks glb_chunks(std::string_view file) {
    if (!file.starts_with("glTF")) refuse("is no .glb file");
    if (file.size() < 20 || word(file, 8) > file.size()) refuse("the file is truncated");
    const std::size_t end = word(file, 8), length = word(file, 12), rest = 20 + length;
    if (word(file, 16) != json_kind || rest > end) refuse("is damaged: its first part is no JSON");
    GlbChunks chunks;
    chunks.json = nlohmann::ordered_json::parse(file.substr(20, length), nullptr, false);
    if (!chunks.json.is_object()) refuse("is damaged: its first part is no JSON");
    if (rest + 8 > end) return chunks;
    if (word(file, rest) > end - rest - 8) refuse("the file is truncated");
    if (word(file, rest + 4) == bytes_kind) chunks.bytes = file.substr(rest + 8, word(file, rest));
    return chunks;
}

std::string glb_file(const nlohmann::ordered_json& json, std::string_view bytes) {
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string file = "glTF";
    add_word(file, 2);
    add_word(file, 0);
    add_chunk(file, json_kind, text, ' ');
    add_chunk(file, bytes_kind, bytes, '\0');
    if (file.size() > UINT32_MAX) refuse("the mesh is too large for .glb (4 GB); write .ply");
    const std::uint32_t length = std::uint32_t(file.size());
    std::memcpy(file.data() + 8, &length, 4);
    return file;
}

} // namespace glcast::format
