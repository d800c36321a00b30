#include "tools/texture/charts.h"

#include <deque>
#include <glm/common.hpp>
#include <limits>
#include <tbb/parallel_for.h>
#include <utility>

#include "tools/texture/plane_cells.h"

namespace glcast {
namespace {

constexpr double inset = 1e-6; // cells: neighbours share a side, which covers nothing twice
constexpr std::uint32_t none = ~0u;

/// The triangles of one connected part, and the grid that they lie on.
class Part {
  public:
    Part(const Mesh& mesh, const Neighbours& neighbours, ViewNumber view, double cell,
         const glm::dvec3& origin, std::span<const std::uint32_t> triangles,
         const std::vector<std::uint32_t>& part_of)
        : mesh(mesh), neighbours(neighbours), triangles(triangles), part_of(part_of),
          number(part_of[triangles[0]]), view(view), cells(1 / cell), shift(in_picture(origin, view)) {
        glm::dvec3 first(std::numeric_limits<double>::infinity()), last(-first);
        for (std::uint32_t t : triangles)
            for (std::uint32_t v : mesh.triangles[t]) {
                first = glm::min(first, mesh.positions[v]);
                last = glm::max(last, mesh.positions[v]);
            }
        low = glm::min(in_picture(first, view), in_picture(last, view));
        high = glm::max(in_picture(first, view), in_picture(last, view));
        const glm::dvec2 one = on_grid(first), other = on_grid(last), start = glm::min(one, other),
                         end = glm::max(one, other);
        x0 = int(std::floor(start.x)), y0 = int(std::floor(start.y));
        width = int(std::ceil(end.x)) - x0 + 1, height = int(std::ceil(end.y)) - y0 + 1;
        grid.assign(std::size_t(width) * height, none);
    }

    /// In its view's picture, model units: those of the chart where there is one only.
    glm::dvec2 low{0}, high{0};

    /// Number of charts; `of` says for each triangle of the part which.
    std::uint32_t split(std::vector<std::uint32_t>& of) {
        bool covers = false;
        for (std::size_t i = 0; i < triangles.size() && !covers; ++i)
            for_cells(corners(triangles[i]), inset, [&](int x, int y) {
                covers = std::exchange(at(x, y), 0) == 0;
                return !covers;
            });
        if (!covers) {
            for (std::uint32_t t : triangles) of[t] = 0;
            return 1;
        }
        std::fill(grid.begin(), grid.end(), none);
        for (std::uint32_t t : triangles) of[t] = none;
        std::uint32_t count = 0;
        for (std::uint32_t seed : triangles)
            if (of[seed] == none) grow(seed, count++, of);
        return count;
    }

  private:
    std::array<glm::dvec2, 3> corners(std::uint32_t t) const {
        std::array<glm::dvec2, 3> out;
        for (int k = 0; k < 3; ++k) out[k] = on_grid(mesh.positions[mesh.triangles[t][k]]);
        return out;
    }
    glm::dvec2 on_grid(const glm::dvec3& p) const { return (in_picture(p, view) - shift) * cells; }
    std::uint32_t& at(int x, int y) { return grid[std::size_t(y - y0) * width + (x - x0)]; }

    /// False, and nothing is done, where the triangle would cover a cell of the chart.
    bool put(std::uint32_t t, std::uint32_t chart) {
        const auto where = corners(t);
        bool free = true;
        for_cells(where, inset, [&](int x, int y) { return free = at(x, y) != chart; });
        if (free)
            for_cells(where, inset, [&](int x, int y) {
                at(x, y) = chart;
                return true;
            });
        return free;
    }

    void grow(std::uint32_t seed, std::uint32_t chart, std::vector<std::uint32_t>& of) {
        std::deque<std::uint32_t> waiting{seed};
        put(seed, chart);
        of[seed] = chart;
        while (!waiting.empty()) {
            const std::uint32_t t = waiting.front();
            waiting.pop_front();
            for (std::uint32_t other : neighbours.across[t]) {
                if (other == no_triangle || !mine(other) || of[other] != none || !put(other, chart)) continue;
                of[other] = chart;
                waiting.push_back(other);
            }
        }
    }
    bool mine(std::uint32_t t) const { return part_of[t] == number; }

    const Mesh& mesh;
    const Neighbours& neighbours;
    const std::span<const std::uint32_t> triangles; // ascending
    const std::vector<std::uint32_t>& part_of;
    const std::uint32_t number;
    const ViewNumber view;
    const double cells; // a model unit
    const glm::dvec2 shift;
    int x0 = 0, y0 = 0, width = 0, height = 0;
    std::vector<std::uint32_t> grid;
};

/// Of the charts of a part, which begin at `first`: their numbers, views and bounds. `whole`: of them all.
void finish(const Mesh& mesh, std::span<const std::uint32_t> triangles, std::span<Charts::Chart> charts,
            std::uint32_t first, const Charts::Chart& whole, Charts& made) {
    if (charts.size() == 1) {
        charts[0] = whole;
        for (std::uint32_t t : triangles) made.of[t] = first;
        return;
    }
    for (auto& chart : charts) {
        chart.view = whole.view;
        chart.low = glm::dvec2(std::numeric_limits<double>::infinity());
        chart.high = -chart.low;
    }
    for (std::uint32_t t : triangles) {
        auto& chart = charts[made.of[t]];
        made.of[t] += first;
        for (std::uint32_t v : mesh.triangles[t]) {
            const glm::dvec2 p = in_picture(mesh.positions[v], whole.view);
            chart.low = glm::min(chart.low, p);
            chart.high = glm::max(chart.high, p);
        }
    }
}

} // namespace

Charts make_charts(const Mesh& mesh, const Neighbours& neighbours, const std::vector<ViewNumber>& views,
                   double cell, const glm::dvec3& origin) {
    std::uint32_t parts = 0;
    const auto part = connected_parts(views, neighbours, parts);
    std::vector<std::uint32_t> start(parts + 1, 0), members(part.size());
    for (std::uint32_t p : part) ++start[p + 1];
    for (std::uint32_t p = 0; p < parts; ++p) start[p + 1] += start[p];
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t t = 0; t < part.size(); ++t) members[next[part[t]]++] = t;

    Charts made;
    made.of.resize(part.size());
    std::vector<std::uint32_t> first(parts + 1, 0);
    std::vector<Charts::Chart> whole(parts);
    const auto own = [&](std::uint32_t p) {
        return std::span<const std::uint32_t>(members.data() + start[p], start[p + 1] - start[p]);
    };
    tbb::parallel_for(std::uint32_t(0), parts, [&](std::uint32_t p) {
        const ViewNumber view = views[own(p)[0]];
        Part one(mesh, neighbours, view, cell, origin, own(p), part);
        first[p + 1] = one.split(made.of);
        whole[p] = {view, one.low, one.high};
    });
    for (std::uint32_t p = 0; p < parts; ++p) first[p + 1] += first[p];
    made.charts.resize(first[parts]);
    tbb::parallel_for(std::uint32_t(0), parts, [&](std::uint32_t p) {
        finish(mesh, own(p), {made.charts.data() + first[p], first[p + 1] - first[p]}, first[p],
               whole[p], made);
    });
    return made;
}

} // namespace glcast
