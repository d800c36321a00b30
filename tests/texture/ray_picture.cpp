#include "tests/texture/ray_picture.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tbb/parallel_for.h>

#include "tools/picture/sample.h"

namespace glcast::test {

class RayScene {
  public:
    explicit RayScene(const Mesh& mesh) : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                       RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                                                       mesh.positions.size()));
        auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) points[i] = glm::vec3(mesh.positions[i]);
        std::copy(mesh.triangles.begin(), mesh.triangles.end(), corners);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }
    ~RayScene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    struct Hit {
        std::uint32_t triangle = RTC_INVALID_GEOMETRY_ID;
        glm::vec3 weights{0};
    };
    Hit first(const glm::vec3& from, const glm::vec3& along) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit ray{};
        ray.ray = {
            from.x, from.y, from.z, 0, along.x, along.y, along.z, 0, std::numeric_limits<float>::infinity(),
            ~0u,    0,      0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {ray.hit.primID, {1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v}};
    }

  private:
    RTCDevice device;
    RTCScene scene;
};

namespace {

constexpr std::uint8_t background = 128;
constexpr int rays = 2; // squared, a pixel

template <class T> T mix(const glm::vec3& w, const T& a, const T& b, const T& c) {
    return w.x * a + w.y * b + w.z * c;
}

struct Surface {
    glm::vec3 colour, normal;
};

Surface at_vertices(const Mesh& mesh, const RayScene::Hit& hit) {
    const Triangle& t = mesh.triangles[hit.triangle];
    return {mix(hit.weights, mesh.colours[t[0]], mesh.colours[t[1]], mesh.colours[t[2]]),
            glm::normalize(mix(hit.weights, mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]]))};
}

Surface textured(const Level& level, const RayScene::Hit& hit) {
    const auto& uv = level.texture.coordinates[hit.triangle];
    const auto& tangents = level.texture.tangents[hit.triangle];
    const Triangle& t = level.mesh.triangles[hit.triangle];
    glm::vec3 bitangents[3];
    for (int k = 0; k < 3; ++k)
        bitangents[k] = tangents[k].w * glm::cross(level.mesh.normals[t[k]], glm::vec3(tangents[k]));
    const glm::vec2 where = mix(hit.weights, uv[0], uv[1], uv[2]);
    const glm::vec3 n = at_vertices(level.mesh, hit).normal,
                    tangent = glm::normalize(mix(hit.weights, glm::vec3(tangents[0]), glm::vec3(tangents[1]),
                                                 glm::vec3(tangents[2]))),
                    bitangent = glm::normalize(mix(hit.weights, bitangents[0], bitangents[1], bitangents[2])),
                    stored = sample(level.texture.normal, where) * 2.0f - 1.0f;
    return {sample(level.texture.colour, where),
            glm::normalize(stored.x * tangent + stored.y * bitangent + stored.z * n)};
}

glm::vec3 shown(const Level& level, const RayView& view, const RayScene::Hit& hit) {
    const Surface s =
        view.vertices || level.texture.empty() ? at_vertices(level.mesh, hit) : textured(level, hit);
    if (view.show == Show::normal) return s.normal * 0.5f + 0.5f;
    if (view.show == Show::colour) return s.colour;
    return s.colour *
           (0.25f + 0.75f * std::max(0.0f, -glm::dot(s.normal, glm::vec3(glm::normalize(view.along)))));
}

} // namespace

RayPictures::RayPictures(const Level& level)
    : level(level), scene(std::make_unique<const RayScene>(level.mesh)) {}
RayPictures::~RayPictures() = default;

Picture RayPictures::operator()(const RayView& view) const {
    const glm::dvec3 along = glm::normalize(view.along),
                     right = glm::normalize(glm::cross(
                         along, std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1))),
                     up = glm::cross(right, along);
    Picture picture{view.size, view.size, std::vector<std::uint8_t>(std::size_t(view.size) * view.size * 3)};
    tbb::parallel_for(0, view.size, [&](int y) {
        for (int x = 0; x < view.size; ++x) {
            glm::vec3 sum(0);
            for (int k = 0; k < rays * rays; ++k) {
                const double px = (x + (k % rays + 0.5) / rays) / view.size * 2 - 1,
                             py = 1 - (y + (k / rays + 0.5) / rays) / view.size * 2;
                const auto hit =
                    scene->first(glm::vec3(view.centre + view.radius * (px * right + py * up - 4.0 * along)),
                                 glm::vec3(along));
                sum += hit.triangle == RTC_INVALID_GEOMETRY_ID ? glm::vec3(background / 255.0f)
                                                               : shown(level, view, hit);
            }
            for (int c = 0; c < 3; ++c)
                picture.rgb[(std::size_t(y) * view.size + x) * 3 + c] =
                    std::uint8_t(std::lround(std::clamp(sum[c] / (rays * rays), 0.0f, 1.0f) * 255));
        }
    });
    return picture;
}

double psnr(const Picture& a, const Picture& b) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        const auto empty = [&](const Picture& p) {
            return p.rgb[i] == background && p.rgb[i + 1] == background && p.rgb[i + 2] == background;
        };
        if (empty(a) && empty(b)) continue;
        for (int c = 0; c < 3; ++c) sum += std::pow(double(a.rgb[i + c]) - b.rgb[i + c], 2), ++count;
    }
    return sum == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(255.0 * 255 * count / sum);
}

} // namespace glcast::test
