#include "tools/deviation/surface_index.h"

#include <glm/common.hpp>
#include <limits>
#include <stdexcept>

#include "tools/mesh/point_triangle.h"

namespace glcast {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
// Rounding of positions to single precision in the unit box, with some room.
constexpr double rounding = 1e-6;

struct Query {
    const Mesh& mesh;
    const glm::dvec3& point;
    double scale;
    double best; ///< squared, model units
    std::uint32_t triangle;
    const glm::dvec3* facing = nullptr; ///< only triangles that face this way
};

bool faces_as(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& normal) {
    const Triangle& t = mesh.triangles[triangle];
    const glm::dvec3& a = mesh.positions[t[0]];
    return dot(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a), normal) > 0;
}

} // namespace

SurfaceIndex::SurfaceIndex(const Mesh& surface, Tree tree) : mesh(surface) {
    if (mesh.triangles.empty()) throw std::runtime_error("cannot measure: the mesh has no triangles");
    glm::dvec3 low(mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : mesh.positions) low = min(low, p), high = max(high, p);
    centre = (low + high) * 0.5;
    const double diagonal = glm::length(high - low);
    scale = diagonal > 0 ? 1 / diagonal : 1;

    device.reset(rtcNewDevice(nullptr));
    if (!device) throw std::runtime_error("cannot measure: Embree gives no device");
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), tree == Tree::quick ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_ROBUST);
    if (tree == Tree::quick) rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(Triangle), mesh.triangles.size());
    if (!points) throw std::runtime_error("cannot measure: no memory for the mesh in Embree");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) points[i] = inside(mesh.positions[i]);
    if (tree == Tree::quick) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryPointQueryFunction(geometry, visit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE)
        throw std::runtime_error("cannot measure: Embree could not build its tree");
}

bool SurfaceIndex::visit(RTCPointQueryFunctionArguments* arguments) {
    Query& query = *static_cast<Query*>(arguments->userPtr);
    if (query.facing && !faces_as(query.mesh, arguments->primID, *query.facing)) return false;
    const Triangle& t = query.mesh.triangles[arguments->primID];
    const glm::dvec3 to = nearest_in_triangle(query.point, query.mesh.positions[t[0]],
                                              query.mesh.positions[t[1]], query.mesh.positions[t[2]])
                              .point -
                          query.point;
    const double found = dot(to, to);
    if (found > query.best || (found == query.best && arguments->primID > query.triangle)) return false;
    const bool shrinks = found < query.best;
    query.best = found;
    query.triangle = arguments->primID;
    if (shrinks) arguments->query->radius = float(std::sqrt(found) * query.scale * (1 + rounding) + rounding);
    return shrinks;
}

SurfaceIndex::Nearest SurfaceIndex::search(const glm::dvec3& point, float radius, const glm::dvec3* facing) const {
    const glm::vec3 at = inside(point);
    RTCPointQuery query{at.x, at.y, at.z, 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Query state{mesh, point, scale, std::numeric_limits<double>::infinity(), UINT32_MAX, facing};
    rtcPointQuery(scene.get(), &query, &context, nullptr, &state);
    return {std::sqrt(state.best), state.triangle};
}

float SurfaceIndex::radius_to(const glm::dvec3& point, std::uint32_t triangle) const {
    return float(distance(point, triangle) * scale * (1 + rounding) + rounding);
}

SurfaceIndex::Nearest SurfaceIndex::nearest(const glm::dvec3& point) const { return search(point, infinity, nullptr); }

SurfaceIndex::Nearest SurfaceIndex::nearest(const glm::dvec3& point, std::uint32_t near) const {
    return search(point, radius_to(point, near), nullptr);
}

SurfaceIndex::Nearest SurfaceIndex::nearest_facing(const glm::dvec3& point, const glm::dvec3& normal,
                                                   const Nearest& nearest) const {
    if (faces(nearest.triangle, normal)) return nearest;
    const Nearest found = search(point, float(2 * nearest.distance * scale + facing_reach), &normal);
    return found.triangle == UINT32_MAX ? nearest : found;
}

bool SurfaceIndex::faces(std::uint32_t triangle, const glm::dvec3& normal) const {
    return faces_as(mesh, triangle, normal);
}

double SurfaceIndex::distance(const glm::dvec3& point, std::uint32_t triangle) const {
    const Triangle& t = mesh.triangles[triangle];
    const glm::dvec3 to =
        nearest_in_triangle(point, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).point - point;
    return std::sqrt(dot(to, to));
}

bool SurfaceIndex::seen(const glm::dvec3& point, const glm::dvec3& normal,
                        std::span<const glm::dvec3> directions) const {
    const glm::dvec3 step = normal * (start_offset / scale);
    const glm::vec3 sides[] = {inside(point - step), inside(point + step)};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (const glm::dvec3& direction : directions) {
        const glm::vec3 start = sides[dot(direction, normal) >= 0], way(direction);
        RTCRay ray{start.x, start.y, start.z, 0, way.x, way.y, way.z, 0, infinity, ~0u, 0, 0};
        rtcOccluded1(scene.get(), &context, &ray);
        if (ray.tfar >= 0) return true; // a hit makes it -infinity
    }
    return false;
}

} // namespace glcast
