// A look into a shared library that is not loaded yet.
#pragma once

namespace glcast::preload {

/// True when `matches` holds for the name of any library that `path` is linked to directly. False for
/// anything that is not a readable ELF file of this machine's word size.
bool any_needed_library(const char* path, bool (*matches)(const char* library));

} // namespace glcast::preload
