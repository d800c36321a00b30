// Edges in order of cost. Internal.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace glcast {

/// Each edge is in it once at most. Costs are not negative: such floats sort like their bits.
class EdgeQueue {
  public:
    /// Edges have numbers below `edges`. Exact: by cost, then by edge. Else what costs the same to a fourth
    /// of an octave comes in any order (the same one every time), several times as fast.
    void start(std::size_t edges, bool exact) {
        is_exact = exact;
        heap.clear();
        if (exact) return;
        next.resize(edges);
        first.fill(none);
        filled.fill(0);
        least = buckets;
    }
    /// In no order yet, until all of it is put in order at once.
    void add(float cost, std::uint32_t edge) {
        is_exact ? heap.push_back(entry_of(cost, edge)) : hang(cost, edge);
    }
    void put_in_order() { std::make_heap(heap.begin(), heap.end(), std::greater<>()); }

    bool empty() const { return is_exact ? heap.empty() : least == buckets; }
    void push(float cost, std::uint32_t edge) {
        add(cost, edge);
        if (is_exact) std::push_heap(heap.begin(), heap.end(), std::greater<>());
    }
    std::uint32_t pop() {
        if (!is_exact) return take();
        std::pop_heap(heap.begin(), heap.end(), std::greater<>());
        const Entry entry = heap.back();
        heap.pop_back();
        return std::uint32_t(entry & UINT32_MAX);
    }
    /// Would it come after another one?
    bool comes_later(float cost, std::uint32_t edge) const {
        return !empty() && (is_exact ? entry_of(cost, edge) > heap.front() : bucket_of(cost) > least);
    }

  private:
    /// Cost and edge in one number: half the size of a pair, and a heap of plain numbers is several times as
    /// fast as one that looks costs up.
    using Entry = std::uint64_t;
    static constexpr std::uint32_t none = UINT32_MAX;
    static constexpr std::size_t buckets = 1024; // eight bits of exponent, two of what follows

    static Entry entry_of(float cost, std::uint32_t edge) {
        return Entry(std::bit_cast<std::uint32_t>(cost)) << 32 | edge;
    }
    static std::size_t bucket_of(float cost) { return std::bit_cast<std::uint32_t>(cost) >> 21; }

    void hang(float cost, std::uint32_t edge) {
        const std::size_t bucket = bucket_of(cost);
        next[edge] = first[bucket];
        first[bucket] = edge;
        filled[bucket / 64] |= std::uint64_t(1) << bucket % 64;
        least = std::min(least, bucket);
    }
    std::uint32_t take() {
        const std::uint32_t edge = first[least];
        first[least] = next[edge];
        if (first[least] != none) return edge;
        std::size_t word = least / 64;
        filled[word] &= ~(std::uint64_t(1) << least % 64);
        while (word < filled.size() && !filled[word]) ++word;
        least = word == filled.size() ? buckets : 64 * word + std::size_t(std::countr_zero(filled[word]));
        return edge;
    }

    bool is_exact = true;
    std::vector<Entry> heap;
    std::array<std::uint32_t, buckets> first{};       ///< by bucket: an edge in it
    std::vector<std::uint32_t> next;                  ///< by edge: another one in its bucket
    std::array<std::uint64_t, buckets / 64> filled{}; ///< bits: buckets that are not empty
    std::size_t least = buckets;                      ///< bucket that is not empty
};

} // namespace glcast
