// glxgears with and without a preload: what a frame costs, where the machine is noisy.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace glcast::test {

/// A frame of glxgears, over the five seconds between the first and the second line that it prints.
struct GearsFrame {
    double wall_seconds = 0;      ///< as glxgears counts
    double processor_seconds = 0; ///< of all its threads
};

/// All zero when it does not run. `environment` is set beside our own.
GearsFrame measure_gears(const std::vector<std::pair<std::string, std::string>>& environment);

/// Median of b / a over rounds in which both were measured one after the other, and the quarter of the rounds
/// that lies below and above: drifts of the machine that are slower than a round fall out.
struct Ratio {
    double median = 0, lower = 0, upper = 0;
};
Ratio ratio_of(const std::vector<double>& a, const std::vector<double>& b);

} // namespace glcast::test
