// Sorting indices. Internal.
#pragma once
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace glcast::progressive {

/// Places in `keys` from the smallest key to the largest, equal ones as they stand: radix sort, eleven bits
/// at a time.
inline std::vector<std::uint32_t> order_of(std::span<const std::uint32_t> keys) {
    constexpr int digit = 11;
    constexpr std::uint32_t mask = (1u << digit) - 1;
    std::uint32_t all = 0;
    for (const std::uint32_t key : keys) all |= key;
    std::vector<std::uint32_t> order(keys.size()), next(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    for (int shift = 0; shift < 32 && all >> shift; shift += digit) {
        std::array<std::size_t, mask + 2> place{};
        for (const std::uint32_t key : keys) ++place[(key >> shift & mask) + 1];
        std::partial_sum(place.begin(), place.end(), place.begin());
        for (const std::uint32_t k : order) next[place[keys[k] >> shift & mask]++] = k;
        order.swap(next);
    }
    return order;
}

} // namespace glcast::progressive
