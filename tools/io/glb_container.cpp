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

std::string glb_head(const nlohmann::ordered_json& json, std::size_t bytes) {
    std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    text.append(glb_padding(text.size()), ' ');
    const std::size_t padded = bytes + glb_padding(bytes), whole = 12 + 8 + text.size() + 8 + padded;
    if (whole > UINT32_MAX) refuse("the mesh is too large for .glb (4 GB); write .ply");
    std::string head = "glTF";
    add_word(head, 2);
    add_word(head, std::uint32_t(whole));
    add_word(head, std::uint32_t(text.size()));
    add_word(head, json_kind);
    head.append(text);
    add_word(head, std::uint32_t(padded));
    add_word(head, bytes_kind);
    return head;
}

std::string glb_file(const nlohmann::ordered_json& json, std::string_view bytes) {
    return glb_head(json, bytes.size()).append(bytes).append(glb_padding(bytes.size()), '\0');
}

} // namespace glcast::format
