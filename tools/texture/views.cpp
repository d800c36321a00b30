#include "tools/texture/views.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

constexpr float flattest = 0.5f;        // cosine: 60 degrees
constexpr float flattest_crumb = 0.17f; // cosine: 80 degrees
constexpr float smoothness = 0.25f;     // of a border edge, against the cosine
constexpr int rounds = 8;

bool may_see(const glm::vec3& normal, ViewNumber view, float least) {
    return normal == glm::vec3(0) || facing(normal, view) >= least;
}

/// Mean of each triangle and its neighbours, though not across a crease.
std::vector<glm::vec3> smoothed(const Neighbours& neighbours, const std::vector<glm::vec3>& normals) {
    std::vector<glm::vec3> out(normals.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), 4096), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            glm::vec3 sum = normals[t];
            for (std::uint32_t other : neighbours.across[t])
                if (other != no_triangle && glm::dot(normals[other], normals[t]) > 0.7f)
                    sum += normals[other];
            const float length = glm::length(sum);
            out[t] = length > 0 ? sum / length : normals[t];
        }
    });
    return out;
}

/// No other view can score higher where all three neighbours have this one, and it may have it.
bool settled(const glm::vec3& smooth, const std::array<std::uint32_t, 3>& across,
             const std::vector<ViewNumber>& before, ViewNumber view) {
    for (std::uint32_t other : across)
        if (other == no_triangle || before[other] != view) return false;
    return facing(smooth, view) > 1.001f - 3 * smoothness;
}

/// One sweep; every triangle looks at what the others were before it.
void sweep(const std::vector<glm::vec3>& normals, const std::vector<glm::vec3>& smooth,
           const Neighbours& neighbours, float border, const std::vector<ViewNumber>& before,
           std::vector<ViewNumber>& after) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), 4096), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            if (border > 0 && settled(smooth[t], neighbours.across[t], before, before[t])) {
                after[t] = before[t];
                continue;
            }
            float score[view_count];
            for (int view = 0; view < view_count; ++view) score[view] = facing(smooth[t], ViewNumber(view));
            if (border > 0)
                for (std::uint32_t other : neighbours.across[t])
                    if (other != no_triangle) score[before[other]] += border;
            int best = -1;
            for (int view = 0; view < view_count; ++view)
                if (may_see(normals[t], ViewNumber(view), flattest) &&
                    (best < 0 || score[view] > score[best]))
                    best = view;
            after[t] = ViewNumber(best); // one of six always sees at 55 degrees or better
        }
    });
}

/// Joins parts smaller than a crumb to larger ones around them, from their borders inwards.
void join_crumbs(const Mesh& mesh, const Neighbours& neighbours, const std::vector<glm::vec3>& normals,
                 double crumb, std::vector<ViewNumber>& views) {
    std::uint32_t count = 0;
    const auto part = connected_parts(views, neighbours, count);
    std::vector<double> area(count, 0);
    for (std::size_t t = 0; t < part.size(); ++t) {
        const Triangle& c = mesh.triangles[t];
        const glm::dvec2 a = in_picture(mesh.positions[c[0]], views[t]),
                         b = in_picture(mesh.positions[c[1]], views[t]) - a,
                         d = in_picture(mesh.positions[c[2]], views[t]) - a;
        area[part[t]] += 0.5 * std::abs(b.x * d.y - b.y * d.x);
    }
    std::vector<std::uint8_t> open(part.size());
    std::deque<std::uint32_t> waiting;
    for (std::uint32_t t = 0; t < part.size(); ++t)
        if ((open[t] = area[part[t]] < crumb)) waiting.push_back(t);
    for (std::size_t since = 0; !waiting.empty() && since <= waiting.size();) {
        const std::uint32_t t = waiting.front();
        waiting.pop_front();
        int best = -1;
        float best_score = flattest_crumb;
        for (std::uint32_t other : neighbours.across[t]) {
            if (other == no_triangle || open[other]) continue;
            const float score = normals[t] == glm::vec3(0) ? 1 : facing(normals[t], views[other]);
            if (score > best_score || (score == best_score && best >= 0 && views[other] < best))
                best = views[other], best_score = score;
        }
        if (best < 0) {
            waiting.push_back(t);
            ++since;
            continue;
        }
        views[t] = ViewNumber(best);
        open[t] = 0;
        since = 0;
    }
}

} // namespace

std::vector<glm::vec3> triangle_normals(const Mesh& mesh) {
    std::vector<glm::vec3> out(mesh.triangles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 4096), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            const Triangle& c = mesh.triangles[t];
            const glm::dvec3 &a = mesh.positions[c[0]], &b = mesh.positions[c[1]], &d = mesh.positions[c[2]];
            const glm::dvec3 area = glm::cross(b - a, d - a);
            const double length = glm::length(area),
                         longest = std::max(glm::length(b - a), glm::length(d - a));
            out[t] = length > 1e-9 * longest * longest ? glm::vec3(area / length) : glm::vec3(0);
        }
    });
    return out;
}

std::vector<ViewNumber> choose_views(const Mesh& mesh, const Neighbours& neighbours,
                                     const std::vector<glm::vec3>& normals, double crumb) {
    const std::vector<glm::vec3> smooth = smoothed(neighbours, smoothed(neighbours, normals));
    std::vector<ViewNumber> views(normals.size()), after(normals.size());
    sweep(normals, smooth, neighbours, 0, views, views);
    for (int round = 0; round < rounds; ++round) {
        sweep(normals, smooth, neighbours, smoothness, views, after);
        views.swap(after);
        if (views == after) break; // nobody changes any more
    }
    join_crumbs(mesh, neighbours, normals, crumb, views);
    return views;
}

std::vector<std::uint32_t> connected_parts(const std::vector<ViewNumber>& views, const Neighbours& neighbours,
                                           std::uint32_t& count) {
    // Union and find, where a root is the first triangle of its part: memory is read in order.
    std::vector<std::uint32_t> part(views.size());
    const auto root = [&](std::uint32_t t) {
        while (part[t] != t) t = part[t] = part[part[t]];
        return t;
    };
    for (std::uint32_t t = 0; t < views.size(); ++t) {
        part[t] = t;
        for (std::uint32_t other : neighbours.across[t]) {
            if (other >= t || views[other] != views[t]) continue; // no_triangle is larger than all
            const std::uint32_t a = root(t), b = root(other);
            part[std::max(a, b)] = std::min(a, b);
        }
    }
    count = 0;
    for (std::uint32_t t = 0; t < part.size(); ++t) part[t] = part[t] == t ? count++ : part[part[t]]; // it is done
    return part;
}

} // namespace glcast
