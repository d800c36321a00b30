#include "tools/pipeline/sized_levels.h"

#include <algorithm>
#include <cmath>

namespace glcast {
namespace {

constexpr int default_levels = 4;
// Of a pixel: errors of a level.
constexpr double p999_share = 1.0 / 8;
constexpr double mean_share = 1.0 / 43, finest_mean_share = 1.0 / 200;
constexpr double outlines_below = 32;       // pixels: of a picture, that many of them are outline
constexpr double full_is_off_below = 64;    // pixels: the full surface bends too, by whole samples
constexpr std::size_t fewest = 4;           // triangles of a closed mesh
constexpr std::size_t most_fitted = 10'000; // triangles, with little work
constexpr double first_count = 65'536;      // triangles; sketches go down from here
constexpr double sketch_step = 4;           // of counts
constexpr double sketch_close_enough = 2;   // of counts between which a limit lies
constexpr double margin = 0.93;             // of the limit: an estimate is no certificate
// Of the errors of a bare level, by the fits: coarse levels gain, of the finest limit the 99.9 % alone.
constexpr double p999_left = 0.85, mean_left = 0.69, finest_mean_to_p999 = 0.1;
constexpr double far_within = 0.6;                 // of the limit
constexpr double least_step = 1.15, most_step = 2; // of counts
constexpr double a_few_more = 1.2;
constexpr double fewer_than_finer = 0.75; // what is tried first, whatever the sketches say

/// So little off on average that outlines are as good as they get.
bool is_finest(const SizedLimit& limit) { return limit.mean < finest_mean_to_p999 * limit.p999; }

} // namespace

std::vector<double> default_pixels(int n) {
    std::vector<double> pixels;
    for (int k = 0; k < default_levels; ++k) pixels.push_back(n / std::exp2(k + 1));
    return pixels;
}

SizedLimit error_within(double pixels, int n) {
    const double pixel = n / pixels, few = std::sqrt(std::min(1.0, pixels / outlines_below));
    double mean = mean_share * few;
    if (2 * pixels >= n) mean = std::min(mean, finest_mean_share * std::max(1.0, full_is_off_below / pixels));
    return {pixel * p999_share, pixel * mean};
}

double LevelSearch::Estimate::share(const SizedLimit& limit) const {
    const bool gains = bare && count <= most_fitted, mean_gains = gains && !is_finest(limit);
    return std::max((gains ? p999_left : 1) * error.p999 / limit.p999,
                    (mean_gains ? mean_left : 1) * error.mean / limit.mean);
}

double LevelSearch::estimate(std::size_t count, const SizedLimit& limit) {
    if (count >= all) { // the full surface itself
        sketches.push_back({double(all), {}, true});
        return 0;
    }
    simplification.collapse_to(count);
    Level level;
    level.mesh = simplification.level(count, FitWork::none);
    const Glance error = meter.glance(level);
    const Estimate made{double(level.mesh.triangles.size()), {error.p999, error.mean}, true};
    const auto at = std::lower_bound(sketches.begin(), sketches.end(), made.count,
                                     [](const Estimate& e, double value) { return e.count < value; });
    if (at == sketches.end() || at->count != made.count) sketches.insert(at, made);
    return made.share(limit);
}

/// Until each limit, as it is before a fit, lies between two counts that are near each other.
void LevelSearch::sketch(const std::vector<SizedLimit>& limits) {
    double count = std::min(first_count, double(all));
    while (estimate(std::size_t(count), limits.front()) > 1 && count < double(all))
        count = std::min(count * sketch_step, double(all));
    count = sketches.front().count;
    while (sketches.front().share(limits.back()) <= 1 && count > fewest) {
        count = std::max(std::floor(count / sketch_step), double(fewest));
        estimate(std::size_t(count), limits.back());
        if (simplification.least() > count) break; // no fewer can be
    }
    for (const SizedLimit& limit : limits)
        for (;;) {
            const auto fine = std::find_if(sketches.begin(), sketches.end(),
                                           [&](const Estimate& e) { return e.share(limit) <= 1; });
            if (fine == sketches.begin() || fine == sketches.end()) break;
            const double high = fine->count, low = std::prev(fine)->count;
            if (high <= sketch_close_enough * low || high - low < 8) break;
            estimate(std::size_t(std::sqrt(high * low)), limit);
        }
}

/// Where a level is likely to be within: the error falls as a power of the count.
double LevelSearch::sketched(const SizedLimit& limit) const {
    const auto fine = std::find_if(sketches.begin(), sketches.end(),
                                   [&](const Estimate& e) { return e.share(limit) <= margin; });
    if (fine == sketches.end()) return double(all);
    if (fine == sketches.begin()) return fine->count;
    const double high = fine->share(limit), low = std::prev(fine)->share(limit);
    if (!(high > 0)) return fine->count;
    const double part = std::log(low / margin) / std::log(low / high);
    return std::prev(fine)->count *
           std::pow(fine->count / std::prev(fine)->count, std::clamp(part, 0.0, 1.0));
}

SizedLevel LevelSearch::make(std::size_t count, bool bare) const {
    return {shape(simplification.level(count, bare ? FitWork::none : FitWork::little), !bare), count, bare};
}

double LevelSearch::share_of(const Level& level, const SizedLimit& limit) const {
    const Glance error = meter.glance(level);
    return Estimate{0, {error.p999, error.mean}, false}.share(limit * margin);
}

/// What its outlines gain a coarse level, the surface of a fine one may lose: then they are left. So is the
/// fit where it costs the finest level what flat faces have of themselves.
SizedLevel LevelSearch::tried(std::size_t count, const SizedLimit& limit, double& share) const {
    if (is_finest(limit)) {
        SizedLevel bare = make(count, true);
        share = share_of(bare.level, limit);
        if (share <= 1 || count > most_fitted) return bare;
    }
    Mesh simplified = simplification.level(count, FitWork::little), plain = simplified;
    SizedLevel made{shape(std::move(simplified), true), count};
    share = share_of(made.level, limit);
    if (share <= 1 || made.level.mesh.positions == plain.positions) return made;
    SizedLevel without{shape(std::move(plain), false), count};
    const double share_without = share_of(without.level, limit);
    if (share_without >= share) return made;
    share = share_without;
    return without;
}

/// A fit costs more than all sketches together: the first level that is within is taken, unless it is so far
/// within that one more try is worth it.
SizedLevel LevelSearch::search(const SizedLimit& limit, const SizedLevel* finer) const {
    const std::size_t finer_has = finer ? finer->level.mesh.triangles.size() : SIZE_MAX;
    const double least = double(std::max(simplification.least(), fewest));
    SizedLevel found;
    double coarse = 0; // the most triangles that were too few
    for (double count = std::max(std::min(sketched(limit), fewer_than_finer * double(finer_has)), least);;) {
        if (count >= double(finer_has)) return found.count ? std::move(found) : *finer;
        double share = 0;
        SizedLevel level = tried(std::size_t(std::min(count, double(all))), limit, share);
        if (level.level.mesh.triangles.size() >= all)
            return found.count ? std::move(found) : std::move(level);
        if (share > 1) {
            if (found.count) return found;
            coarse = count;
            count *= std::clamp(share, least_step, most_step);
            continue;
        }
        const bool first = found.count == 0;
        found = std::move(level);
        count = std::floor(count * std::max(share * least_step, 1 / most_step));
        if (!first || share > far_within || count <= std::max(coarse, least)) return found;
    }
}

std::vector<SizedLevel> LevelSearch::coarsest_within(const std::vector<SizedLimit>& limits) {
    if (limits.empty()) return {};
    sketch(limits);
    std::vector<SizedLevel> levels(limits.size());
    for (std::size_t k = 0; k < limits.size(); ++k)
        levels[k] = search(limits[k], k ? &levels[k - 1] : nullptr);
    return levels;
}

SizedLevel LevelSearch::finer(const SizedLevel& level) const {
    return make(std::min(all, std::size_t(double(level.count) * a_few_more) + 2), level.bare);
}

} // namespace glcast
