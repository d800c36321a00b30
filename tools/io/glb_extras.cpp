#include "tools/io/glb_extras.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/io/level_set.h"
#include "tools/mesh/error_names.h"

namespace glcast::format {
namespace {

using tinygltf::Value;

constexpr double screen_pixels = 1920.0 * 1080.0;

double diagonal(const Mesh& mesh) {
    glm::dvec3 lo = mesh.positions.at(0), hi = lo;
    for (const glm::dvec3& p : mesh.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return glm::length(hi - lo);
}

/// The largest share of the screen at which an error of one level is hidden.
double hidden_below(const Level& level, const Level& full, double diameter) {
    const double error = level.error.p999;
    if (error > 0) return std::numbers::pi / 4 * (diameter / error) * (diameter / error) / screen_pixels;
    return double(level.mesh.triangles.size()) / double(full.mesh.triangles.size());
}

} // namespace

double number_in(const Value& object, const char* name, double otherwise) {
    if (!object.IsObject() || !object.Has(name) || !object.Get(name).IsNumber()) return otherwise;
    const double number = object.Get(name).GetNumberAsDouble();
    return std::isfinite(number) ? number : otherwise;
}

Value level_extras(const Level& level) {
    Value::Object extras{{"triangles", Value(static_cast<int>(level.mesh.triangles.size()))},
                         {"sample", Value(level.sample)}};
    for (const ErrorName& e : error_names) extras[e.name] = Value(level.error.*e.value);
    if (level.pixels > 0) extras["pixels"] = Value(level.pixels);
    if (level.set.count > 0) extras[mark_name] = Value(mark_of(level.set));
    return Value(extras);
}

void read_extras(const Value& extras, Level& level) {
    for (const ErrorName& e : error_names)
        level.error.*e.value = std::max(level.error.*e.value, number_in(extras, e.name));
    level.sample = std::max(level.sample, number_in(extras, "sample"));
    level.pixels = std::max(level.pixels, number_in(extras, "pixels"));
}

std::vector<double> screen_coverage(std::span<const Level> levels) {
    const double diameter = diagonal(levels[0].mesh);
    std::vector<double> coverage;
    double last = 1;
    for (std::size_t k = 1; k < levels.size(); ++k)
        coverage.push_back(last = std::min(last, hidden_below(levels[k], levels[0], diameter)));
    coverage.push_back(0);
    return coverage;
}

} // namespace glcast::format
