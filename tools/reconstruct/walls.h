// Which lattice edges a surface crosses, a slice of samples at a time.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/reconstruct/rays.h"

namespace glcast {

/// Hits along z ordered by the slice whose edge to the next they cross.
class SliceHits {
  public:
    explicit SliceHits(const Rays& rays);
    struct At {
        std::uint16_t x, y;
    };
    const At* begin(int z) const { return hits.data() + start[z]; }
    const At* end(int z) const { return hits.data() + start[z + 1]; }

  private:
    std::vector<std::size_t> start;
    std::vector<At> hits;
};

/// A hit so near to a sample walls it off on both sides: whether the surface passes before or behind it is
/// noise, and the three axes would not agree. Samples.
inline constexpr float on_sample = 0.004f;

/// Calls cross(i) for the edges i -> i + 1 of a ray of n samples that a hit at `depth` crosses: one, or two
/// when it is at a sample. Edges beyond the box are left out.
template <class Cross> void for_crossed_edges(float depth, int n, Cross cross) {
    const int low = int(std::floor(depth - on_sample)), high = int(std::floor(depth + on_sample));
    for (int i = std::max(low, 0); i <= high && i < n - 1; ++i) cross(i);
}

/// The walls about the samples of one slice: bit x of a row is the edge from sample x.
class Walls {
  public:
    Walls(const Rays& rays, const SliceHits& along_z);
    /// Cheap when z is the slice after the last one.
    void load(int z);
    const Word* x(int y) const { return &along[0][words * y]; }       ///< to (x + 1, y, z)
    const Word* y(int y) const { return &along[1][words * (y + 1)]; } ///< to (x, y + 1, z); y = -1 too
    const Word* above(int y) const { return &along[2][words * y]; }   ///< to (x, y, z + 1)
    const Word* below(int y) const { return &along[3][words * y]; }   ///< from (x, y, z - 1)
    const std::size_t words;

  private:
    void load_above(int z, std::vector<Word>& out) const;
    const Rays& rays;
    const SliceHits& along_z;
    const int n;
    int loaded = -2;
    std::vector<Word> along[4]; ///< along[1] has an empty row before row 0
};

} // namespace glcast
