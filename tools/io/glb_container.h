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

/// Throws std::runtime_error when it is no .glb, or not all of one.
GlbChunks glb_chunks(std::string_view file);

std::string glb_file(const nlohmann::ordered_json& json, std::string_view bytes);

} // namespace glcast::format
