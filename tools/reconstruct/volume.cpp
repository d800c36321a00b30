#include "tools/reconstruct/volume.h"

#include <algorithm>

namespace glcast {

void SliceRuns::add_row(const Word* bits, int n) {
    const std::size_t before = runs.size();
    for (int x = next_bit(bits, 0, n, true); x < n;) {
        const int end = next_bit(bits, x, n, false);
        runs.push_back({std::uint16_t(x), std::uint16_t(end - 1)});
        x = next_bit(bits, end, n, true);
    }
    row_runs.push_back(std::uint32_t(runs.size() - before));
}

Volume::Volume(int n, std::vector<SliceRuns>& slices) : n(n) {
    std::vector<std::size_t> first{0};
    start.reserve(std::size_t(n) * n + 1);
    start.push_back(0);
    for (const SliceRuns& slice : slices) {
        for (std::uint32_t count : slice.row_runs) start.push_back(start.back() + count);
        first.push_back(first.back() + slice.runs.size());
    }
    runs.resize(first.back());
    tbb::parallel_for(std::size_t(0), slices.size(), [&](std::size_t z) {
        std::copy(slices[z].runs.begin(), slices[z].runs.end(), runs.begin() + first[z]);
        slices[z] = {};
    });
}

bool Volume::has(const std::array<int, 3>& s) const {
    if (s[0] < 0 || s[1] < 0 || s[2] < 0 || s[0] >= n || s[1] >= n || s[2] >= n) return false;
    const Run *from = begin(s[1], s[2]), *to = end(s[1], s[2]);
    const Run* after = std::upper_bound(from, to, s[0], [](int x, const Run& run) { return x < run.first; });
    return after != from && s[0] <= after[-1].last;
}

void Volume::set_bits(int y, int z, Word* bits) const {
    for (const Run* run = begin(y, z); run != end(y, z); ++run) set_range(bits, run->first, run->last);
}

std::size_t Volume::samples() const {
    std::size_t count = 0;
    for (const Run& run : runs) count += run.last - run.first + 1u;
    return count;
}

void Volume::add(std::vector<std::uint64_t> samples) {
    if (samples.empty()) return;
    std::sort(samples.begin(), samples.end());
    *this = make_volume(n, [&](int y, int z, Word* bits) {
        set_bits(y, z, bits);
        const SampleId row = id_of({0, y, z}, n);
        for (auto at = std::lower_bound(samples.begin(), samples.end(), row);
             at != samples.end() && *at < row + n; ++at)
            set_bit(bits, int(*at - row));
    });
}

} // namespace glcast
