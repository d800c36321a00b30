// Lists of GL calls as values: named one by one, or by class (capture/gl/call_classes.h).
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast {

/// Members of GlTable.
template <auto... Members> struct Calls {};

template <auto... A, auto... B> constexpr Calls<A..., B...> operator+(Calls<A...>, Calls<B...>) { return {}; }

template <auto... Members> inline constexpr Calls<Members...> only{};

/// Which arguments of a draw say how much it draws; -1 where none does.
struct DrawArguments {
    int count = -1;     ///< of elements, in one draw or in each of many
    int instances = -1; ///< how often it is drawn
    int number = -1;    ///< of many draws: how many there are, and `count` is an array
};
template <auto Member> inline constexpr DrawArguments draw_arguments{};

} // namespace glcast
