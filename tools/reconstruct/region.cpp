#include "tools/reconstruct/region.h"

#include <algorithm>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

/// Words of the row that hold a sample.
std::uint32_t count_words(const Volume& volume, int y, int z) {
    std::uint32_t count = 0;
    int last = -1;
    for (const Run* run = volume.begin(y, z); run != volume.end(y, z); ++run) {
        const int from = std::max(run->first >> 6, last + 1);
        last = run->last >> 6;
        count += std::uint32_t(last + 1 - from);
    }
    return count;
}

} // namespace

Region::Region(const Rays& rays, const SliceHits& along_z, const Volume& volume) : n(volume.n) {
    start.resize(std::size_t(n) * n + 1, 0);
    tbb::parallel_for(0, n, [&](int z) {
        for (int y = 0; y < n; ++y) start[row(y, z) + 1] = count_words(volume, y, z);
    });
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    number.resize(start.back());
    samples.resize(start.back() + std::size_t(1), 0);
    links.resize(samples.size());
    fill_rows(rays, along_z, volume);
    tbb::parallel_for(0, n, [&](int z) {
        for (int y = 0; y < n; ++y) link_row(y, z);
    });
}

void Region::fill_rows(const Rays& rays, const SliceHits& along_z, const Volume& volume) {
    for_slabs(n, [&](int z0, int z1) {
        Walls walls(rays, along_z);
        std::vector<Word> bits(walls.words);
        for (int z = z0; z < z1; ++z) {
            if (start[row(0, z)] == start[row(0, z + 1)]) continue;
            walls.load(z);
            for (int y = 0; y < n; ++y) {
                std::size_t i = start[row(y, z)];
                if (i == start[row(y, z) + 1]) continue;
                std::fill(bits.begin(), bits.end(), 0);
                volume.set_bits(y, z, bits.data());
                for (std::size_t w = 0; w < bits.size(); ++w) {
                    if (!bits[w]) continue;
                    number[i] = std::uint16_t(w);
                    samples[i] = bits[w];
                    links[i++].walls = {walls.x(y)[w], walls.y(y)[w], walls.above(y)[w]};
                }
            }
        }
    });
}

std::uint32_t Region::find(int y, int z, int wanted) const {
    const auto none = std::uint32_t(number.size());
    if (y < 0 || z < 0 || y >= n || z >= n) return none;
    const auto first = number.begin() + start[row(y, z)], last = number.begin() + start[row(y, z) + 1];
    const auto at = std::lower_bound(first, last, wanted);
    return at != last && *at == wanted ? std::uint32_t(at - number.begin()) : none;
}

void Region::link_row(int y, int z) {
    for (std::uint32_t i = start[row(y, z)]; i < start[row(y, z) + 1]; ++i) {
        const int w = number[i];
        links[i].before = {find(y, z, w - 1), find(y - 1, z, w), find(y, z - 1, w)};
        links[i].after = {find(y, z, w + 1), find(y + 1, z, w), find(y, z + 1, w)};
    }
}

Region::Set Region::common(const Volume& volume) const {
    Set out(samples.size(), 0);
    tbb::parallel_for(0, n, [&](int z) {
        std::vector<Word> bits(words_of(n));
        for (int y = 0; y < n; ++y) {
            const std::size_t first = start[row(y, z)], last = start[row(y, z) + 1];
            if (first == last || volume.begin(y, z) == volume.end(y, z)) continue;
            std::fill(bits.begin(), bits.end(), 0);
            volume.set_bits(y, z, bits.data());
            for (std::size_t i = first; i < last; ++i) out[i] = samples[i] & bits[number[i]];
        }
    });
    return out;
}

Word Region::reached(const Set& set, std::size_t i) const {
    const Links& at = links[i];
    const auto from_below = [&](std::size_t word, int axis) { return set[word] & ~links[word].walls[axis]; };
    Word out = from_below(i, 0) << 1 | from_below(at.before[0], 0) >> 63;
    out |= (set[i] >> 1 | set[at.after[0]] << 63) & ~at.walls[0];
    for (int axis : {1, 2})
        out |= from_below(at.before[axis], axis) | (set[at.after[axis]] & ~at.walls[axis]);
    return out;
}

Region::Set Region::grown(const Set& set, const Set& within) const {
    Set out(set.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, number.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            out[i] = within[i] & ~set[i] ? set[i] | (reached(set, i) & within[i]) : set[i];
    });
    return out;
}

void Region::clear(const Set& set, int y, int z, Word* bits) const {
    for (std::size_t i = start[row(y, z)]; i < start[row(y, z) + 1]; ++i) bits[number[i]] &= ~set[i];
}

} // namespace glcast
