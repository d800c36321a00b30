#include "tools/simplify/facing_grid.h"

#include <array>
#include <cmath>

namespace glcast {
namespace {

// Cosine; far above what rounding does to the normal of a triangle that is no needle.
constexpr float clearly = 0.1f;
constexpr float cell_per_triangle = 3; // sides
constexpr int most_cells = 64;         // along an axis
constexpr int large = 100;             // cells

constexpr std::size_t axes = 16; // each of them two directions

/// By component, so that the sums run over all at once.
struct Directions {
    std::array<float, axes> x{}, y{}, z{};
};

Directions make_directions() {
    const float golden = (1 + std::sqrt(5.0f)) / 2;
    Directions d;
    std::size_t k = 0;
    const auto add = [&](float x, float y, float z) {
        const float length = std::sqrt(x * x + y * y + z * z);
        d.x[k] = x / length, d.y[k] = y / length, d.z[k] = z / length;
        ++k;
    };
    for (const float sign : {-1.0f, 1.0f}) {
        add(0, 1, sign * golden), add(1, sign * golden, 0), add(golden, 0, sign); // corners
        add(0, 1 / golden, sign * golden), add(1 / golden, sign * golden, 0), add(golden, 0, sign / golden);
        for (const float other : {-1.0f, 1.0f}) add(1, sign, other); // faces are a dodecahedron's corners
    }
    return d;
}

} // namespace

Facing facing(const glm::vec3& normal) {
    static const Directions directions = make_directions();
    std::array<float, axes> along;
    for (std::size_t k = 0; k < axes; ++k)
        along[k] = directions.x[k] * normal.x + directions.y[k] * normal.y + directions.z[k] * normal.z;
    Facing faced = 0;
    for (std::size_t k = 0; k < axes; ++k)
        faced |= Facing(along[k] > clearly) << k | Facing(along[k] < -clearly) << (k + axes);
    return faced;
}

FacingGrid::FacingGrid(const std::vector<BoxTree::Item>& items) {
    if (items.empty()) return;
    FloatBox all;
    double sides = 0;
    for (const BoxTree::Item& item : items) {
        all.add(item.box);
        const glm::vec3 side = item.box.high - item.box.low;
        sides += std::max({side.x, side.y, side.z});
    }
    low = all.low;
    const glm::vec3 extent = all.high - all.low;
    const float longest = std::max({extent.x, extent.y, extent.z}),
                cell =
                    std::max(cell_per_triangle * float(sides / double(items.size())), longest / most_cells);
    per_unit = cell > 0 ? 1 / cell : 0;
    for (int k = 0; k < 3; ++k) size[k] = std::clamp(int(extent[k] * per_unit) + 1, 1, most_cells + 1);
    cells.assign(std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]), ~Facing(0));
    for (const BoxTree::Item& item : items) add(item.box, facing(item.normal));
}

FacingGrid::Range FacingGrid::range_of(const FloatBox& box) const {
    Range range;
    for (int k = 0; k < 3; ++k) {
        const float most = float(size[k] - 1);
        range.low[k] = int(std::clamp((box.low[k] - low[k]) * per_unit, 0.0f, most));
        range.high[k] = int(std::clamp((box.high[k] - low[k]) * per_unit, 0.0f, most));
    }
    return range;
}

Facing FacingGrid::common(const FloatBox& box, Facing faced) const {
    if (range_of(box).count() > large) return 0;
    each(box, [&](std::size_t cell) { faced &= cells[cell]; });
    return faced;
}

} // namespace glcast
