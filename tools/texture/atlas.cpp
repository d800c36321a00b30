// Skyline packing by stb_rect_pack.
#include "tools/texture/atlas.h"

#include <cmath>
#include <stdexcept>
#include <string>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace glcast {
namespace {

constexpr int halvings = 12;       // of the interval of densities: within 1/1000 or so
constexpr double coarsest = 1e-3;  // of the finest
constexpr int smallest_gutter = 2; // texels: a bilinear filter needs one on each side

Atlas lay_out(const Charts& charts, int size, int gutter, double density, const glm::dvec3& origin) {
    Atlas atlas{size, gutter, density, {}};
    for (const auto& chart : charts.charts) {
        const glm::dvec2 shift = -in_picture(origin, chart.view);
        const glm::dvec2 low = (chart.low + shift) * density, high = (chart.high + shift) * density;
        Atlas::Place place;
        place.shift = shift * density - glm::dvec2(std::floor(low.x), std::floor(low.y)) + 0.5;
        place.width = int(std::floor(high.x - std::floor(low.x) + 0.5)) + 1;
        place.height = int(std::floor(high.y - std::floor(low.y) + 0.5)) + 1;
        atlas.places.push_back(place);
    }
    return atlas;
}

bool place_all(Atlas& atlas) {
    std::vector<stbrp_rect> rects(atlas.places.size());
    for (std::size_t i = 0; i < rects.size(); ++i) {
        const int width = atlas.places[i].width + atlas.gutter,
                  height = atlas.places[i].height + atlas.gutter;
        if (width > atlas.size || height > atlas.size) return false;
        rects[i] = {int(i), stbrp_coord(width), stbrp_coord(height), 0, 0, 0};
    }
    std::vector<stbrp_node> nodes(atlas.size);
    stbrp_context context;
    stbrp_init_target(&context, atlas.size, atlas.size, nodes.data(), atlas.size);
    if (!stbrp_pack_rects(&context, rects.data(), int(rects.size()))) return false;
    for (const stbrp_rect& rect : rects) {
        Atlas::Place& place = atlas.places[rect.id];
        place.x = int(rect.x) + atlas.gutter / 2;
        place.y = int(rect.y) + atlas.gutter / 2;
        place.shift += glm::dvec2(place.x, place.y);
    }
    return true;
}

} // namespace

Atlas pack(const Charts& charts, int size, int gutter, double finest, const glm::dvec3& origin) {
    const auto attempt = [&](double density, int between) {
        Atlas atlas = lay_out(charts, size, between, density, origin);
        if (!place_all(atlas)) atlas.size = 0;
        return atlas;
    };
    Atlas best;
    for (int between = gutter; between >= smallest_gutter && !best.size; between /= 2) {
        best = attempt(finest, between);
        if (best.size) return best;
        best = attempt(finest * coarsest, between);
        double fits = coarsest, fails = 1;
        for (int step = 0; step < halvings && best.size; ++step) {
            const double middle = step < 3 ? std::sqrt(fits * fails) : 0.5 * (fits + fails);
            Atlas atlas = attempt(finest * middle, between);
            if (atlas.size) {
                best = std::move(atlas);
                fits = middle;
            } else
                fails = middle;
        }
    }
    if (!best.size)
        throw AtlasTooSmall("a texture of " + std::to_string(size) + " texels is too small for " +
                                 std::to_string(charts.charts.size()) + " charts; ask for a larger one");
    return best;
}

Atlas pack_tightly(const Charts& charts, int largest, int gutter, double density, const glm::dvec3& origin) {
    double area = 0;
    for (const Atlas::Place& place : lay_out(charts, largest, gutter, density, origin).places)
        area += double(place.width + gutter) * (place.height + gutter);
    for (int size = 64; size <= largest; size *= 2) {
        if (double(size) * size < area) continue;
        Atlas atlas = lay_out(charts, size, gutter, density, origin);
        if (place_all(atlas)) return atlas;
    }
    return pack(charts, largest, gutter, density, origin);
}

} // namespace glcast
