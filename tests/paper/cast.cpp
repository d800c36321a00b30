#include "tests/paper/cast.h"

#include <chrono>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "tests/support/osmesa_context.h"

namespace glcast::paper {
namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void draw(const GlTable& gl, const Mesh& mesh) {
    constexpr float white[] = {1, 1, 1, 1};
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_LIGHTING);
    gl.Enable(GL_LIGHT0);
    gl.Lightfv(GL_LIGHT0, GL_DIFFUSE, white);
    gl.Enable(GL_COLOR_MATERIAL);
    gl.ColorMaterial(GL_FRONT_AND_BACK, GL_DIFFUSE);
    gl.Color3f(1, 1, 1);
    gl.Begin(GL_TRIANGLES);
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const glm::dvec3 flat = glm::normalize(glm::cross(b - a, c - a));
        for (const std::uint32_t v : t) {
            const glm::dvec3 normal = mesh.normals.empty() ? flat : glm::dvec3(mesh.normals[v]);
            const glm::dvec3& p = mesh.positions[v];
            if (!mesh.colours.empty()) gl.Color3f(mesh.colours[v].r, mesh.colours[v].g, mesh.colours[v].b);
            gl.Normal3d(normal.x, normal.y, normal.z);
            gl.Vertex3d(p.x, p.y, p.z);
        }
    }
    gl.End();
}

} // namespace

Capture capture_mesh(const Mesh& mesh, int n) {
    test::OsmesaContext context;
    Capture capture;
    capture.n = n;
    EngineOptions options;
    options.n = n;
    const double start = now();
    const EngineReport report = run_capture(
        context.gl(), [&](const GlTable& gl) { draw(gl, mesh); }, options,
        [&](ViewImage&& image) {
            capture.images.push_back(std::move(image));
            return true;
        });
    if (!report.ok) throw std::runtime_error("the capture failed: " + report.error);
    capture.box = report.box;
    capture.complete_layers = report.layers == Layers::complete;
    capture.seconds = now() - start;
    return capture;
}

Cast reconstruct_capture(const Capture& capture, SurfaceMethod method, Views views, bool geometric_normals) {
    Cast cast;
    ReconstructOptions options;
    options.method = method;
    options.complete_layers = capture.complete_layers;
    if (method == SurfaceMethod::cubes || views == Views::six) options.exterior = ExteriorRule::axes;
    options.geometric_normals = geometric_normals;
    const double start = now();
    cast.mesh = reconstruct(capture.images, capture.box, options, &cast.report);
    cast.seconds = now() - start;
    return cast;
}

} // namespace glcast::paper
