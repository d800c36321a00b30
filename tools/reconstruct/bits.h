// A row of samples as bits: bit x & 63 of word x >> 6 is sample x.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace glcast {

using Word = std::uint64_t;

inline std::size_t words_of(int bits) { return (std::size_t(bits) + 63) / 64; }
inline bool test_bit(const Word* row, int x) { return row[x >> 6] >> (x & 63) & 1; }
inline void set_bit(Word* row, int x) { row[x >> 6] |= Word(1) << (x & 63); }

/// Bits of a word from position `from` to `to`, 0..63, both included.
inline Word word_range(int from, int to) { return (~Word(0) << from) & (~Word(0) >> (63 - to)); }

inline void set_range(Word* row, int first, int last) {
    const int from = first >> 6, to = last >> 6;
    if (from == to) {
        row[from] |= word_range(first & 63, last & 63);
        return;
    }
    row[from] |= word_range(first & 63, 63);
    for (int w = from + 1; w < to; ++w) row[w] = ~Word(0);
    row[to] |= word_range(0, last & 63);
}

/// Word w of the row moved by one sample up (towards larger x) or down; zeros move in.
inline Word moved_up(const Word* row, std::size_t w) { return row[w] << 1 | (w ? row[w - 1] >> 63 : 0); }
inline Word moved_down(const Word* row, std::size_t w, std::size_t words) {
    return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}

/// The first x at or after `from` whose bit is `value`, or `n`.
inline int next_bit(const Word* row, int from, int n, bool value) {
    const Word flip = value ? 0 : ~Word(0);
    for (int x = from; x < n; x = (x | 63) + 1)
        if (const Word left = (row[x >> 6] ^ flip) >> (x & 63)) {
            const int found = x + std::countr_zero(left);
            return found < n ? found : n;
        }
    return n;
}

} // namespace glcast
