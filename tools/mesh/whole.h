// std::floor, ceil and lround are calls where the processor need not have SSE 4.1. For what fits an int.
#pragma once

namespace glcast {

inline int whole_below(double x) {
    const int cut = int(x);
    return cut - (x < cut);
}
inline int whole_above(double x) { return -whole_below(-x); }
inline int nearest_whole(double x) { return whole_below(x + 0.5); } ///< halves go up

} // namespace glcast
