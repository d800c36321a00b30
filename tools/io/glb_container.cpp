#include "tools/io/glb_container.h"

#include <algorithm>
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

/// Brackets within brackets, those in texts left out.
std::size_t nesting(std::string_view json) {
    std::size_t depth = 0, deepest = 0;
    bool in_text = false;
    for (std::size_t k = 0; k < json.size(); ++k) {
        const char c = json[k];
        if (in_text && c == '\\') ++k;
        if (c == '"') in_text = !in_text;
        if (in_text) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if ((c == ']' || c == '}') && depth > 0) --depth;
    }
    return deepest;
}

void add_word(std::string& file, std::uint32_t value) {
    file.append(reinterpret_cast<const char*>(&value), 4);
}

} // namespace

nlohmann::ordered_json gltf_json(std::string_view text) {
    constexpr std::size_t deepest = 100;
    if (nesting(text) > deepest) refuse("is nested deeper than " + std::to_string(deepest) + " brackets");
    auto json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!json.is_object()) refuse("is damaged: its description is no JSON");
    return json;
}

GlbChunks glb_chunks(std::string_view file) {
    if (!file.starts_with("glTF")) refuse("is no .glb file");
    if (file.size() < 20 || word(file, 8) > file.size()) refuse("the file is truncated");
    const std::size_t end = word(file, 8), length = word(file, 12), rest = 20 + length;
    if (word(file, 16) != json_kind || rest > end) refuse("is damaged: its first part is no JSON");
    GlbChunks chunks;
    chunks.json = gltf_json(file.substr(20, length));
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
