// A thin set of samples, to be flooded 64 samples at once: only the words along x that hold any of it are
// there, with the walls between them. Levels of a flood are the number of steps taken.
#pragma once
#include <array>

#include "tools/reconstruct/walls.h"

namespace glcast {

class Region {
  public:
    using Set = std::vector<Word>; ///< samples of the region, by word; one more that is empty

    Region(const Rays& rays, const SliceHits& along_z, const Volume& samples);
    const Set& all() const { return samples; }
    /// Those of the volume.
    Set common(const Volume& volume) const;
    /// `set` and the samples of `within` one step from it across an edge without a wall.
    Set grown(const Set& set, const Set& within) const;
    /// Takes the set's samples out of a row of the volume.
    void clear(const Set& set, int y, int z, Word* row) const;

  private:
    struct Links {
        std::array<std::uint32_t, 3> before, after; ///< words by axis; the empty one where there is none
        std::array<Word, 3> walls;                  ///< between a sample and the next along the axis
    };
    std::size_t row(int y, int z) const { return std::size_t(z) * n + y; }
    void fill_rows(const Rays& rays, const SliceHits& along_z, const Volume& volume);
    void link_row(int y, int z);
    std::uint32_t find(int y, int z, int number) const;
    Word reached(const Set& set, std::size_t i) const;

    const int n;
    std::vector<std::uint32_t> start;  ///< by row; one more at the end
    std::vector<std::uint16_t> number; ///< of the word in its row
    Set samples;
    std::vector<Links> links;
};

} // namespace glcast
