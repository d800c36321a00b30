// A set of samples of the box, as runs along x: memory grows with its surface, not with the volume.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "tools/reconstruct/bits.h"

namespace glcast {

struct Run {
    std::uint16_t first, last; ///< both included
};

/// The runs of one slice of constant z, built row by row.
struct SliceRuns {
    std::vector<Run> runs;
    std::vector<std::uint32_t> row_runs; ///< how many, by y

    void add_row(const Word* bits, int n);
    void add_empty_row() { row_runs.push_back(0); }
};

class Volume {
  public:
    Volume() = default;
    /// `slices` by z, n rows each; they are left empty.
    Volume(int n, std::vector<SliceRuns>& slices);

    int n = 0;
    std::vector<std::uint32_t> start; ///< by row z * n + y; one more at the end
    std::vector<Run> runs;            ///< ascending and apart within a row

    std::size_t row(int y, int z) const { return std::size_t(z) * n + y; }
    const Run* begin(int y, int z) const { return runs.data() + start[row(y, z)]; }
    const Run* end(int y, int z) const { return runs.data() + start[row(y, z) + 1]; }
    /// Any sample; there are none outside the box.
    bool has(const std::array<int, 3>& s) const;
    /// Sets the row's bits, `words_of(n)` of them; the others stay.
    void set_bits(int y, int z, Word* row) const;
    std::size_t samples() const;
    /// Adds samples given as (z * n + y) * n + x, in any order.
    void add(std::vector<std::uint64_t> samples);
};

} // namespace glcast
