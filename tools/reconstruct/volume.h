// A set of samples of the box, as runs along x: memory grows with its surface, not with the volume.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <tbb/parallel_for.h>
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
    /// Adds samples given as SampleId, in any order.
    void add(std::vector<std::uint64_t> samples);
};

/// Samples z, y, x packed as (z * n + y) * n + x.
using SampleId = std::uint64_t;
inline SampleId id_of(const std::array<int, 3>& s, int n) { return (SampleId(s[2]) * n + s[1]) * n + s[0]; }
inline std::array<int, 3> sample_of(SampleId id, int n) {
    return {int(id % n), int(id / n % n), int(id / n / n)};
}

/// Slices that a task takes: what it must load beside them costs little then.
inline constexpr int slab = 16;
/// Calls task(z0, z1) for slabs of slices z0 .. z1 - 1 on all cores.
template <class Task> void for_slabs(int n, Task task) {
    tbb::parallel_for(0, (n + slab - 1) / slab, [&](int i) { task(i * slab, std::min(n, (i + 1) * slab)); });
}

/// The samples whose bits set_row(y, z, bits) sets; the bits come empty. On all cores.
template <class SetRow> Volume make_volume(int n, SetRow set_row) {
    std::vector<SliceRuns> slices(n);
    tbb::parallel_for(0, n, [&](int z) {
        std::vector<Word> bits(words_of(n));
        for (int y = 0; y < n; ++y) {
            std::fill(bits.begin(), bits.end(), 0);
            set_row(y, z, bits.data());
            slices[z].add_row(bits.data(), n);
        }
    });
    return Volume(n, slices);
}

} // namespace glcast
