#pragma once
#include <cstddef>

namespace glcast::record {

/// Whether memory can be read without a fault. A program may leave an array enabled that nothing draws from,
/// with a pointer to memory that it has given back: GL never looks there, so we must not fall over it. True
/// where the system cannot say.
bool is_readable(const void* from, std::size_t bytes);

} // namespace glcast::record
