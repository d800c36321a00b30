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
};

} // namespace

SurfaceIndex::SurfaceIndex(const Mesh& surface) : mesh(surface) {
    if (mesh.triangles.empty()) throw std::runtime_error("cannot measure: the mesh has no triangles");
    glm::dvec3 low(mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : mesh.positions) low = min(low, p), high = max(high, p);
    centre = (low + high) * 0.5;
    const double diagonal = glm::length(high - low);
    scale = diagonal > 0 ? 1 / diagonal : 1;

    device.reset(rtcNewDevice(nullptr));
    if (!device) throw std::runtime_error("cannot measure: Embree gives no device");
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
    if (!points || !corners) throw std::runtime_error("cannot measure: no memory for the mesh in Embree");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) points[i] = inside(mesh.positions[i]);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) corners[i] = mesh.triangles[i];
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

SurfaceIndex::Nearest SurfaceIndex::nearest(const glm::dvec3& point) const {
    const glm::vec3 at = inside(point);
    RTCPointQuery query{at.x, at.y, at.z, 0, infinity};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Query state{mesh, point, scale, std::numeric_limits<double>::infinity(), UINT32_MAX};
    rtcPointQuery(scene.get(), &query, &context, nullptr, &state);
    return {std::sqrt(state.best), state.triangle};
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
