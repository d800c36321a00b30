#include "tools/pipeline/max_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "tools/deviation/level_error.h"

namespace glcast {
namespace {

constexpr double fewest = 4;       // triangles of a closed mesh
constexpr double first_step = 4;   // of triangles, from level to level, by collapses alone: they need no fit
constexpr double margin = 1.5;     // the fit moves the answer by less, most often
constexpr int levels_a_search = 3; // of one run of collapses; each is fitted
constexpr double close_enough = 1.05;

class Search {
  public:
    Search(const Level& full, double limit) : full(full), meter(full), limit(limit) {}

    /// The first of the counts, ascending, whose level is within the limit; how many there are where none is.
    std::size_t first_within(const std::vector<double>& counts, const SimplifyOptions& options) const {
        std::vector<SimplifyTarget> targets;
        for (const double count : counts) targets.push_back({SimplifyTarget::Unit::triangles, count});
        std::vector<Mesh> meshes = simplify_levels(full.mesh, targets, options);
        std::size_t low = 0, high = counts.size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            const Level level{std::move(meshes[middle]), "", {}, full.sample, {}};
            if (meter.measure(level).max <= limit)
                high = middle;
            else
                low = middle + 1;
        }
        return low;
    }

  private:
    const Level& full;
    LevelMeter meter;
    double limit;
};

std::vector<double> between(double coarse, double fine) {
    std::vector<double> counts;
    for (int k = 1; k <= levels_a_search; ++k)
        counts.push_back(std::floor(coarse * std::pow(fine / coarse, double(k) / (levels_a_search + 1))));
    return counts;
}

} // namespace

std::string ErrorLimit::text() const {
    char number[40];
    std::snprintf(number, sizeof number, "%.10g", value);
    return number + std::string(unit == Unit::units ? "u" : unit == Unit::percent ? "%" : "");
}

double ErrorLimit::in_units(const Level& full) const {
    if (unit == Unit::units) return value;
    if (unit == Unit::samples) {
        if (!(full.sample > 0))
            throw std::runtime_error("--max-error: the sample is not known; give units, as in 0.5u");
        return value * full.sample;
    }
    glm::dvec3 low(full.mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : full.mesh.positions) low = min(low, p), high = max(high, p);
    return value / 100 * distance(low, high);
}

ErrorLimit parse_error_limit(const std::string& text) {
    ErrorLimit limit;
    std::string number = text;
    if (number.ends_with('u')) limit.unit = ErrorLimit::Unit::units;
    if (number.ends_with('%')) limit.unit = ErrorLimit::Unit::percent;
    if (limit.unit != ErrorLimit::Unit::samples) number.pop_back();
    std::size_t read = 0;
    try {
        limit.value = std::stod(number, &read);
    } catch (const std::exception&) {
        read = 0;
    }
    if (read == 0 || read != number.size() || !(limit.value > 0) || !std::isfinite(limit.value))
        throw std::runtime_error(
            "'" + text + "' is no error: give samples (0.5), units (0.5u) or part of the diagonal (0.1%)");
    return limit;
}

SimplifyTarget coarsest_within(const Level& full, double limit, const SimplifyOptions& options) {
    const Search search(full, limit);
    const double all = double(full.mesh.triangles.size());
    std::vector<double> counts;
    for (double count = all / first_step; count > fewest; count /= first_step)
        counts.push_back(std::floor(count));
    std::reverse(counts.begin(), counts.end());
    SimplifyOptions bare = options;
    bare.refit = false;
    const std::size_t found = search.first_within(counts, bare);
    // Within the limit is `fine`, as far as is known; `coarse` is not.
    double fine = found < counts.size() ? std::min(all, counts[found] * margin) : all;
    double coarse = std::max(found > 0 ? counts[found - 1] / margin : fewest, fewest);
    bool measured = false; // `fine`
    while (fine > close_enough * coarse + 2) {
        const std::vector<double> tried = between(coarse, fine);
        const std::size_t first = search.first_within(tried, options);
        if (first < tried.size()) fine = tried[first], measured = true;
        if (first > 0) coarse = tried[first - 1];
    }
    while (!measured && fine < all) {
        measured = search.first_within({fine}, options) == 0;
        if (!measured) fine = std::min(all, std::floor(fine * margin));
    }
    return {SimplifyTarget::Unit::triangles, fine};
}

} // namespace glcast
