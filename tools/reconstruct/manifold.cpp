#include "tools/reconstruct/manifold.h"

#include <stdexcept>
#include <string>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

/// Triangles by vertex: those of v are at[start[v]] .. at[start[v + 1]].
struct Incidence {
    std::vector<std::uint32_t> start, at;
    Incidence(std::span<const Triangle> triangles, std::size_t vertices)
        : start(vertices + 2), at(triangles.size() * 3) {
        for (const Triangle& t : triangles)
            for (std::uint32_t v : t) ++start[v + 2];
        for (std::size_t v = 2; v < start.size(); ++v) start[v] += start[v - 1];
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::uint32_t v : triangles[t]) at[start[v + 1]++] = std::uint32_t(t);
    }
};

/// The edge opposite to v: the fan steps from its first to its second end.
std::pair<std::uint32_t, std::uint32_t> step(const Triangle& t, std::uint32_t v) {
    if (t[0] == v) return {t[1], t[2]};
    if (t[1] == v) return {t[2], t[0]};
    return {t[0], t[1]};
}

bool one_closed_fan(std::span<const Triangle> triangles, std::span<const std::uint32_t> around,
                    std::uint32_t v) {
    if (around.size() < 3) return false;
    const auto first = step(triangles[around[0]], v).first;
    auto at = first;
    for (std::size_t steps = 0; steps < around.size(); ++steps) {
        int found = 0;
        std::uint32_t next = 0;
        for (std::uint32_t t : around) {
            const auto [from, to] = step(triangles[t], v);
            if (from != at) continue;
            ++found;
            next = to;
        }
        if (found != 1) return false;
        at = next;
        if (at == first) return steps + 1 == around.size();
    }
    return false;
}

} // namespace

void assert_manifold(std::span<const Triangle> triangles, std::size_t vertices) {
    for (const Triangle& t : triangles)
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || t[0] >= vertices || t[1] >= vertices ||
            t[2] >= vertices)
            throw std::logic_error("reconstruct made a triangle of fewer than three vertices");
    const Incidence incidence(triangles, vertices);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices, 4096), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const std::span around(&incidence.at[incidence.start[v]],
                                   incidence.start[v + 1] - incidence.start[v]);
            if (!one_closed_fan(triangles, around, std::uint32_t(v)))
                throw std::logic_error("reconstruct made a mesh that is not manifold at vertex " +
                                       std::to_string(v));
        }
    });
}

} // namespace glcast
