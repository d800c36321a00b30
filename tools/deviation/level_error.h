// The error certificate of a level of detail: how far it is from the full surface, and how it looks beside
// it.
#pragma once
#include <memory>
#include <span>

#include "tools/mesh/level.h"

namespace glcast {

struct Glance {
    double mean = 0, p999 = 0; ///< model units
};

/// Measures levels against one full surface, of which one tree is built. `full` must outlive this, unchanged.
///
/// Mean and 99.9 % are over 100,000 points spread evenly by area, on each of the two surfaces in turn, the
/// larger of the two; so are those of normals and colours, which are compared with the nearest point that
/// faces the same way, so that the sides of a thin sheet do not get mixed up. The maximum is over these
/// points and all vertices of both surfaces. Hidden parts count as all others. Colours are left at 0 where
/// one of the two has none. Shares of unsupported area and of disagreeing normals are those of `full`. The
/// same levels give the same numbers, bit for bit, on any number of threads.
class LevelMeter {
  public:
    explicit LevelMeter(const Level& full); ///< Throws std::runtime_error on a mesh without triangles.
    ~LevelMeter();
    LevelError measure(const Level& level) const; ///< the same
    /// From a tenth of the points: how far the surface is on average, and 99.9 % of it at most, nearly.
    Glance glance(const Level& level) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

LevelError measure_level(const Level& full, const Level& level);

} // namespace glcast
