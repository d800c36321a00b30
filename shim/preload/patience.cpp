#include "shim/preload/patience.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace glcast::preload {
namespace {

/// A cast without layers: the box, and for each of six views colours and normals; then a little. Each layer
/// of an axis takes three more at least.
constexpr int fewest_renders = 20, renders_a_layer = 3;
constexpr double long_cast = 10; ///< seconds
/// The first time a frame is drawn the driver compiles shaders and uploads, so the faster of two times tells;
/// unless the first alone is such a part of a long cast.
constexpr double long_first = 5; ///< seconds

template <class... Values> std::string text(const char* format, Values... values) {
    char line[300];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

} // namespace

Patience::Patience(double most_seconds, PatienceLines to, std::function<Seconds()> clock_to_ask)
    : most(most_seconds), lines(std::move(to)), now(std::move(clock_to_ask)), start(now()) {}

Patience::Seconds Patience::clock() { return std::chrono::steady_clock::now().time_since_epoch(); }

std::string Patience::how_far(Seconds at) const {
    const std::string where = has_image
                                  ? text("axis %c, layer %d", "xyz"[static_cast<int>(last.axis)], last.layer)
                                  : std::string("the box");
    return where + text(", drawn %ld time%s, %.0f s", renders, renders == 1 ? "" : "s", (at - start).count());
}

void Patience::announce(Seconds render) {
    has_announced = true;
    lines.slow(text("this frame takes %.2g s to draw, and the cast draws it %d times and %d more for each "
                    "layer of an axis: %.0f s "
                    "or more, in which the program stands still (--layers 1, --max-seconds S)",
                    render.count(), fewest_renders, renders_a_layer, render.count() * fewest_renders));
}

void Patience::render_begins() {
    const Seconds at = now();
    const Seconds render = at - render_start; // reading what it drew included
    if (renders > 0) fastest = renders > 1 ? std::min(fastest, render) : render;
    const bool known = renders > 1 || (renders == 1 && render.count() >= long_first);
    if (known && !has_announced && fastest.count() * fewest_renders >= long_cast) announce(fastest);
    if (has_announced && (at - told).count() >= 1) {
        told = at;
        lines.progress(how_far(at));
    }
    if (most > 0 && (at - start).count() >= most) {
        why_over = text("gave up after %.3g s, as asked (--max-seconds), at ", most) + how_far(at) +
                   ": a smaller -n, --layers 1 or more seconds help";
        throw std::runtime_error(why_over);
    }
    ++renders;
    render_start = at;
}

} // namespace glcast::preload
