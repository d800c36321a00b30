#include "tools/reconstruct/captured_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "tools/mesh/whole.h"
#include "tools/reconstruct/attributes.h"
#include "tools/reconstruct/behind.h"
#include "tools/reconstruct/sides.h"

namespace glcast {
namespace {

constexpr int steps = 6;            // of the walk to where a line meets the surface; it mostly needs two
constexpr int outline = 3;          // samples: how far a coarse level may reach beyond what a view covers
constexpr double arrived = 0.02;    // samples
constexpr float steepest = 0.25f;   // cosine: views that see a surface flatter than this are not asked
constexpr float looked_into = 0.5f; // cosine: openings are looked into along axes no farther from the facing
constexpr float same_way = 0.2f;    // cosine between the asked and the found facing
constexpr float across_line = 0.3f; // cosine: a line nearer to a plane's own directions is not followed
constexpr float same_place = 1e-3f; // samples: the two sides of a sheet

/// A hit and the plane through it, outward.
struct Plane {
    glm::dvec3 at{0}; ///< samples
    glm::vec3 normal{0};
    std::uint32_t hit = no_hit;
};

/// Finds surface by the rays of one axis, seen from one side.
template <int axis> class Walk {
  public:
    Walk(const Rays& rays, const glm::vec3& facing)
        : rays(rays), hits(rays.axis[axis]), side(facing[axis] > 0 ? 1 : 0), facing(facing) {}

    /// From `from` along the line; where it leads off the surface, the last plane under way. `beside`: the
    /// first pixel may be so many beside the point.
    std::optional<Plane> run(const glm::dvec3& from, const glm::vec3& along, double reach, int beside) const {
        glm::dvec3 at = from;
        std::optional<Plane> found;
        for (int step = 0; step < steps; ++step) {
            auto next = nearest(at, from[axis], reach);
            if (!next && step == 0) next = nearest_beside(at, reach, beside);
            if (!next) break;
            found = next;
            const double slope = glm::dot(next->normal, along);
            if (std::abs(slope) < across_line) break;
            const double far = glm::dot(glm::dvec3(next->normal), next->at - from) / slope;
            if (std::abs(far) > reach) break;
            const glm::dvec3 to = from + far * glm::dvec3(along);
            const glm::dvec3 stride = to - at;
            const bool done = glm::dot(stride, stride) < arrived * arrived;
            at = to;
            if (done) break;
        }
        if (found) found->at = on_plane(*found, at);
        return found;
    }

  private:
    /// The hit of the pixel at a point that faces our side, nearest in depth to `depth`.
    std::optional<Plane> nearest(const glm::dvec3& at, double depth, double reach) const {
        const int u = nearest_whole(at[axes.u]), v = nearest_whole(at[axes.v]);
        if (u < 0 || v < 0 || u >= rays.n || v >= rays.n) return std::nullopt;
        const std::size_t pixel = std::size_t(v) * rays.n + u;
        const std::uint32_t wanted = side ? seen_from_plus : seen_from_minus;
        Plane best;
        double away = reach;
        for (std::uint32_t i = hits.start[pixel]; i < hits.start[pixel + 1]; ++i) {
            if (!(hits.colour[i] & wanted) || !hits.plane[i]) continue;
            const double distance = std::abs(hits.depth[i] - depth);
            if (distance > away + (side ? same_place : -same_place)) continue;
            glm::vec3 normal = unpack_normal(hits.plane[i]);
            if ((normal[axis] > 0) != (side == 1)) normal = -normal;
            if (glm::dot(normal, facing) < same_way) continue;
            away = std::min(away, distance);
            best.normal = normal;
            best.hit = i;
        }
        if (best.hit == no_hit) return std::nullopt;
        best.at[axes.u] = u;
        best.at[axes.v] = v;
        best.at[axis] = hits.depth[best.hit];
        return best;
    }

    /// The same in the pixel nearest to the point that has one.
    std::optional<Plane> nearest_beside(const glm::dvec3& at, double reach, int beside) const {
        std::optional<Plane> best;
        double least = (beside + 0.5) * (beside + 0.5);
        for (int dv = -beside; dv <= beside; ++dv)
            for (int du = -beside; du <= beside; ++du) {
                glm::dvec3 there = at;
                there[axes.u] = std::round(at[axes.u]) + du;
                there[axes.v] = std::round(at[axes.v]) + dv;
                const double away_u = there[axes.u] - at[axes.u], away_v = there[axes.v] - at[axes.v],
                             away = away_u * away_u + away_v * away_v;
                if (away >= least) continue;
                if (const auto found = nearest(there, at[axis], reach)) best = found, least = away;
            }
        return best;
    }

    /// The point of the plane in the pixel of its hit that lies nearest to `at` along the rays.
    glm::dvec3 on_plane(const Plane& plane, glm::dvec3 at) const {
        for (int k : {axes.u, axes.v}) at[k] = std::clamp(at[k], plane.at[k] - 0.5, plane.at[k] + 0.5);
        const glm::dvec3 off = at - plane.at;
        at[axis] =
            plane.at[axis] - (plane.normal[axes.u] * off[axes.u] + plane.normal[axes.v] * off[axes.v]) /
                                 std::copysign(std::max(std::abs(double(plane.normal[axis])), 0.1),
                                               double(plane.normal[axis]));
        return at;
    }

    static constexpr ImageAxes axes = image_axes(Axis(axis));
    const Rays& rays;
    const AxisHits& hits;
    const int side;
    const glm::vec3 facing;
};

/// What lies behind a closing at `start`: along the axis, where its rays have found no surface; else along
/// another, where the closing is nearer than what they found, as in a slit whose wall faces the same way.
HitBehind nearest_closing(const Rays& rays, const glm::dvec3& start, const glm::vec3& facing, int axis,
                          const std::optional<Plane>& found, double reach) {
    if (!found) {
        if (axis != main_axis(facing) && std::abs(facing[axis]) < looked_into) return {};
        return hit_behind_closing(rays, start, facing, axis, reach);
    }
    const double away = std::abs(glm::dot(glm::dvec3(found->normal), found->at - start));
    for (int other = 0; other < 3; ++other) {
        const double cosine = std::abs(facing[other]);
        if (other == axis || cosine < looked_into) continue;
        const HitBehind there = hit_behind_closing(rays, start, facing, other, reach);
        if (there && there.away * cosine < away) return there;
    }
    return {};
}

} // namespace

CapturedSurface::CapturedSurface(Rays&& given, const Box& box, bool geometric_normals)
    : rays(std::make_shared<const Rays>(std::move(given))), box(box), geometric_normals(geometric_normals) {}

int CapturedSurface::resolution() const { return rays ? rays->n : 0; }
double CapturedSurface::sample() const { return rays ? box.size / rays->n : 0; }
glm::dvec3 CapturedSurface::first_sample() const { return box.lo + 0.5 * sample(); }
glm::dvec3 CapturedSurface::to_samples(const glm::dvec3& position) const {
    return (position - box.lo) / sample() - 0.5;
}

CapturedPoint CapturedSurface::seen_at(int axis, const glm::dvec3& at, const glm::vec3& plane,
                                       std::uint32_t hit) const {
    CapturedPoint out;
    out.found = true;
    out.position = box.lo + (at + 0.5) * sample();
    const Attribute seen = sample_point(*rays, at, plane);
    const AxisHits& hits = rays->axis[axis];
    const int side = plane[axis] > 0;
    out.colour = seen.found ? seen.colour : unpack_colour(hits.colour_to(side, hit));
    out.normal = seen.found ? seen.plane : plane;
    if (geometric_normals) return out;
    if (seen.found ? seen.normal != glm::vec3(0) : hits.normal_to(side, hit) != 0)
        out.normal = seen.found ? seen.normal : unpack_normal(hits.normal_to(side, hit));
    return out;
}

CapturedPoint CapturedSurface::find(const glm::dvec3& from, const glm::vec3& along, const glm::vec3& facing,
                                    double reach) const {
    return find_from(from, along, facing, reach, false);
}

CapturedPoint CapturedSurface::look(const glm::dvec3& from, const glm::vec3& along, const glm::vec3& facing,
                                    double reach) const {
    return find_from(from, along, facing, reach, true);
}

CapturedPoint CapturedSurface::find_from(const glm::dvec3& from, const glm::vec3& along,
                                         const glm::vec3& facing, double reach, bool look_behind) const {
    if (!rays) return {};
    int order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](int a, int b) {
        const float fa = std::abs(facing[a]), fb = std::abs(facing[b]);
        return fa != fb ? fa > fb : a < b;
    });
    const glm::dvec3 start = to_samples(from);
    for (int beside : {0, outline})
        for (int axis : order) {
            if (std::abs(facing[axis]) < steepest) break;
            const auto plane = axis == 0   ? Walk<0>(*rays, facing).run(start, along, reach, beside)
                               : axis == 1 ? Walk<1>(*rays, facing).run(start, along, reach, beside)
                                           : Walk<2>(*rays, facing).run(start, along, reach, beside);
            if (look_behind && !beside)
                if (const HitBehind there = nearest_closing(*rays, start, facing, axis, plane, reach))
                    return shown_behind(start, facing, there);
            if (plane) return seen_at(axis, plane->at, plane->normal, plane->hit);
        }
    return {};
}

CapturedPoint CapturedSurface::shown_behind(const glm::dvec3& start, const glm::vec3& facing,
                                            const HitBehind& there) const {
    const AxisHits& hits = rays->axis[there.axis];
    CapturedPoint out;
    out.found = out.behind = true;
    glm::dvec3 at = start;
    at[there.axis] = hits.depth[there.hit];
    out.position = box.lo + (at + 0.5) * sample();
    const int side = facing[there.axis] > 0;
    out.colour = unpack_colour(hits.colour_to(side, there.hit));
    const std::uint32_t normal = geometric_normals ? 0 : hits.normal_to(side, there.hit);
    out.normal = normal ? unpack_normal(normal) : facing;
    return out;
}

} // namespace glcast
