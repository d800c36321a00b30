// The page less its data, made from page/ at build time. Internal.
#pragma once
#include <string_view>

namespace glcast::view {

/// Where the data goes in the template.
inline constexpr std::string_view data_mark = "<!--glcast:data-->";

/// Empty when the program was built without three.js or esbuild.
std::string_view page_template();

} // namespace glcast::view
