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

/// How far a level may be from the full surface, both ways.
struct SizedLimit {
    double p999 = 0; ///< 99.9 % of it
    double mean = 0;

    SizedLimit operator*(double factor) const { return {p999 * factor, mean * factor}; }
};

/// Where the capture's n samples are drawn `pixels` wide, in samples. 99.9 % within an eighth of a pixel: 2^k
/// / 4 at n / 2^(k+1) pixels. The mean within a 43rd of a pixel; less in pictures below 32 pixels, as more of
/// their pixels lie on outlines; and within a 200th from n / 2 pixels on, where the full surface can be
/// matched: more below 64 pixels, where that is coarse itself.
SizedLimit error_within(double pixels, int n);

/// A level as a file will have it, but for its normals, colours and texture: made of what a count leaves.
/// `outlines`: its vertices are moved for them.
using ShapeLevel = std::function<Level(Mesh&& simplified, bool outlines)>;

struct SizedLevel {
    Level level;
    std::size_t count = 0; ///< triangles that were asked of the simplification
    bool bare = false;     ///< without a fit
};

/// Looks for levels by the count of their triangles. Errors of some counts are estimated before any is
/// fitted, as that costs little; what they tell gives the counts that are tried.
class LevelSearch {
  public:
    /// All must outlive it. `shape` may run on several threads at once.
    LevelSearch(Simplification& simplification, const LevelMeter& meter, std::size_t all, ShapeLevel shape)
        : simplification(simplification), meter(meter), all(all), shape(std::move(shape)) {}

    /// For each limit (model units, ascending) the coarsest level, to some 15 % of its triangles, that is
    /// within it, by estimate (LevelMeter::glance). The full surface where none is; the finer level again
    /// where one would need no fewer triangles.
    std::vector<SizedLevel> coarsest_within(const std::vector<SizedLimit>& limits);

    /// One with a few more triangles, for one that turned out to be too coarse; the full surface at last.
    SizedLevel finer(const SizedLevel& level) const;

  private:
    struct Estimate {
        double count;
        SizedLimit error;
        bool bare;                                   ///< before a fit, which leaves less
        double share(const SizedLimit& limit) const; ///< that is likely after a fit
    };
    double estimate(std::size_t count, const SizedLimit& limit);
    void sketch(const std::vector<SizedLimit>& limits);
    double sketched(const SizedLimit& limit) const;
    SizedLevel search(const SizedLimit& limit, const SizedLevel* finer) const;
    SizedLevel make(std::size_t count, bool bare) const;
    SizedLevel tried(std::size_t count, const SizedLimit& limit, double& share) const;
    double share_of(const Level& level, const SizedLimit& limit) const;

    Simplification& simplification;
    const LevelMeter& meter;
    const std::size_t all;
    const ShapeLevel shape;
    std::vector<Estimate> sketches; ///< without a fit; by count, ascending
};

} // namespace glcast
