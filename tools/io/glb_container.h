// The two chunks of a .glb: JSON and bytes. Internal.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace glcast::format {

struct GlbChunks {
    nlohmann::ordered_json json;
    std::string_view bytes; ///< of the file; empty where there is no second chunk
};

/// The description of a .gltf, or of a .glb. Throws std::runtime_error when it is no JSON object, or nested deeper than
/// anybody nests: readers behind it recurse.
nlohmann::ordered_json gltf_json(std::string_view text);

/// Throws std::runtime_error when it is no .glb, or not all of one.
GlbChunks glb_chunks(std::string_view file);

std::string glb_file(const nlohmann::ordered_json& json, std::string_view bytes);

/// What stands before so many bytes; behind them come zeros up to a multiple of four.
std::string glb_head(const nlohmann::ordered_json& json, std::size_t bytes);
inline std::size_t glb_padding(std::size_t bytes) { return (4 - bytes % 4) % 4; }

} // namespace glcast::format
