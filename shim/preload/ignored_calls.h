// Calls of a table that do nothing.
#pragma once
#include <type_traits>
#include <utility>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Ignored;
template <auto Member, class R, class... A> struct Ignored<Member, R (*)(A...)> {
    static R APIENTRY call(A...) { return R(); }
};

/// From now on `table` does nothing where `Members` are called.
template <auto... Members> void ignore(GlTable& table) { ((table.*Members = Ignored<Members>::call), ...); }

} // namespace glcast::preload
