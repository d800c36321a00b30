// Levels for sizes on the screen: how many triangles an object needs that is drawn so many pixels wide.
// n = 2 w: Natvig 2006, section 3; two samples of the capture a pixel are as fine as anybody can see.
#pragma once
#include <functional>
#include <vector>

#include "tools/deviation/level_error.h"
#include "tools/simplify/simplify.h"

namespace glcast {

/// Widths in pixels that the levels of default are for: n / 2, n / 4, n / 8, n / 16.
std::vector<double> default_pixels(int n);

/// How far 99.9 % of a level may be from the full surface, both ways, where the capture's n samples are drawn
/// `pixels` wide: an eighth of a pixel, in samples. 2^k / 4 at n / 2^(k+1) pixels.
double error_within(double pixels, int n);

/// A level as a file will have it, but for its normals, colours and texture: made of what a count leaves.
using ShapeLevel = std::function<Level(Mesh&& simplified)>;

struct SizedLevel {
    Level level;
    std::size_t count = 0; ///< triangles that were asked of the simplification
};

/// Looks for levels by the count of their triangles. Errors of some counts are estimated before any is
/// fitted, as that costs little; what they tell gives the counts that are tried.
class LevelSearch {
  public:
    /// All must outlive it. `shape` may run on several threads at once.
    LevelSearch(Simplification& simplification, const LevelMeter& meter, std::size_t all, ShapeLevel shape)
        : simplification(simplification), meter(meter), all(all), shape(std::move(shape)) {}

    /// For each limit (model units, ascending) the coarsest level, to some 15 % of its triangles, 99.9 % of
    /// which are within it, by estimate (LevelMeter::glance). The full surface where none is.
    std::vector<SizedLevel> coarsest_within(const std::vector<double>& limits);

    /// One with a few more triangles, for one that turned out to be too coarse; the full surface at last.
    SizedLevel finer(const SizedLevel& level) const;

  private:
    struct Estimate {
        double count, error;
    };
    double estimate(std::size_t count);
    void sketch(const std::vector<double>& limits);
    double sketched(double limit) const;
    double first_try(double limit) const;
    SizedLevel search(double limit) const;
    SizedLevel make(std::size_t count) const;

    Simplification& simplification;
    const LevelMeter& meter;
    const std::size_t all;
    const ShapeLevel shape;
    std::vector<Estimate> sketches; ///< without a fit; by count, ascending
};

} // namespace glcast
