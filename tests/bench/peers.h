// Other people's extraction of a surface from a volume, for comparison. Which there are depends on what the
// build found; tools/install-packages bench installs them.
#pragma once
#include <functional>
#include <vector>

namespace glcast::test {

double cpu_seconds(); ///< of this process so far

struct PeerResult {
    std::size_t triangles = 0; ///< quads count twice
    double seconds = 0;        ///< of the extraction alone, the volume in the peer's own form before
    double cpu_seconds = 0;
    double resident_before = 0; ///< megabytes
};

struct Peer {
    const char* name;
    /// `volume`: n^3 samples, x fastest, 1 inside. `ready` is called just before the extraction.
    PeerResult (*run)(const std::vector<unsigned char>& volume, int n, const std::function<void()>& ready);
};

const std::vector<Peer>& peers();

} // namespace glcast::test
