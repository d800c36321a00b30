#include "tools/simplify/refit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/simplify/corners.h"
#include "tools/simplify/level_fit.h"

namespace glcast {
namespace {

struct Amount {
    std::size_t samples_per_vertex, most_walks, most_rounds;
};
// Measured on teapots and spheres: four times the samples gain 2 %, twice the rounds 3 %.
constexpr Amount full{48, 1'200'000, 24}; // about a second
constexpr Amount little{12, 60'000, 4};
constexpr std::size_t least_samples = 1'500, most_samples = 200'000;
constexpr std::size_t too_few_per_vertex = 12, most_idle_rounds = 4;
constexpr double worth_a_round = 0.002; // of the squared distances
// Of some hundred triangles a fit ends in one of many least sums. So several are made, in which points of the
// level first pull less hard than they are judged by.
constexpr std::size_t few_vertices = 400, samples_of_few = 6'000;
constexpr double pulls_of_few[] = {0.3};

std::vector<Sample> spread(const SurfaceArea& over, const std::vector<std::uint32_t>& became,
                           std::size_t count) {
    const std::vector<AreaPoint> points = area_points(over, count);
    std::vector<Sample> samples(points.size());
    tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) {
        const Triangle& triangle = over.surface.triangles[points[i].triangle];
        const Corners at(over.surface, triangle);
        samples[i] = {at.at(points[i].weights), unit(at.normal()), became[triangle[0]], triangle[0]};
    });
    return samples;
}

/// A level, and its sum as LevelFit judges it.
struct Fitted {
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;
    double squares = std::numeric_limits<double>::infinity();
};

/// What a round makes of it may be worse: the best one is returned.
Fitted fitted(const Fitted& start, bool closed, std::vector<Sample> samples, double spacing,
              const SurfaceWalk& along, std::size_t rounds, double back) {
    Mesh level;
    level.positions = start.positions;
    level.triangles = start.triangles;
    LevelFit fit(level, closed, std::move(samples), spacing, along, back);
    Fitted best;
    for (std::size_t round = 0, idle = 0;; ++round) {
        const double squares = fit.lay();
        idle = squares < (1 - worth_a_round) * best.squares ? 0 : idle + 1;
        if (squares < best.squares) best = {level.positions, level.triangles, squares};
        if (round == rounds || idle == most_idle_rounds) return best;
        fit.move_vertices();
        fit.swap_edges();
    }
}

} // namespace

void refit(Collapser::Remainder& remainder, const SurfaceArea& surface, const SurfaceWalk& along,
           FitWork work) {
    const Amount amount = work == FitWork::full ? full : little;
    const std::size_t vertices = remainder.positions.size();
    const bool few = work == FitWork::full && vertices <= few_vertices;
    const std::size_t count =
        std::clamp(amount.samples_per_vertex * vertices, few ? samples_of_few : least_samples, most_samples);
    const std::size_t rounds = std::min(amount.most_rounds, amount.most_walks / count);
    if (work == FitWork::none || rounds == 0 || count < too_few_per_vertex * vertices) return;
    const std::vector<Sample> samples = spread(surface, remainder.became, count);
    if (samples.empty()) return;
    const double spacing = std::sqrt(surface.total() / double(count));
    const Fitted start{remainder.positions, remainder.triangles};
    const auto from = [&](const Fitted& begin, double back) {
        return fitted(begin, remainder.closed, samples, spacing, along, rounds, back);
    };
    Fitted best = from(start, 1);
    if (few)
        for (const double back : pulls_of_few) {
            Fitted other = from(from(start, back), 1);
            if (other.squares < best.squares) best = std::move(other);
        }
    remainder.positions = std::move(best.positions);
    remainder.triangles = std::move(best.triangles);
}

} // namespace glcast
