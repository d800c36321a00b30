// Finding the box by drawing.
#pragma once
#include <optional>

#include "capture/engine_pass.h"

namespace glcast {

/// The cube around all that is drawn, 2 samples of margin at n; see find_box. Draws 9 times a round.
std::optional<Box> search_box(PassRunner& passes, const Target& target, const Box& search, int n);

/// Side of the target that search_box needs for captures of n.
int box_target_size(int n);

} // namespace glcast
