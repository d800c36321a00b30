// What the tests of depth layers share.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "capture/engine_peel.h"
#include "tests/capture/layer_truth.h"
#include "tests/support/osmesa_context.h"

namespace glcast::test {

inline const Box view_box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};
inline const Box wide_box{glm::dvec3(-1.213, -1.207, -1.221), 2.44};
inline const glm::vec3 red(0.8f, 0.1f, 0.2f), green(0.1f, 0.7f, 0.3f), blue(0.15f, 0.25f, 0.9f);

class LayersOf : public testing::Test {
  protected:
    OsmesaContext context;
    const GlTable& gl = context.gl();
    EngineOptions options = small_options(64);

    void SetUp() override {
        options.box = view_box;
        options.most_layers = 32;
    }
    Cast cast_of(const DrawFunction& draw) { return capture(gl, draw, options); }
    Cast complete_cast_of(const DrawFunction& draw) {
        Cast cast = cast_of(draw);
        EXPECT_TRUE(cast.report.ok) << cast.report.error;
        EXPECT_EQ(cast.report.layers, Layers::complete);
        EXPECT_EQ(cast.report.layer_method, options.layer_method);
        return cast;
    }
};

inline void nested_spheres(const GlTable& gl) {
    set_lit(gl);
    set_diffuse(gl, red);
    draw_sphere(gl, glm::dvec3(0.01), 0.9, 64);
    set_diffuse(gl, green);
    draw_sphere(gl, glm::dvec3(0.1, 0.05, -0.1), 0.6, 64);
    set_diffuse(gl, blue);
    draw_sphere(gl, glm::dvec3(0.2, 0.02, -0.1), 0.3, 64);
}
inline const std::vector<BodyPtr> nested_bodies{sphere(glm::dvec3(0.01), 0.9, red),
                                                sphere({0.1, 0.05, -0.1}, 0.6, green),
                                                sphere({0.2, 0.02, -0.1}, 0.3, blue)};

inline void quad(const GlTable& gl, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    const glm::dvec3 n = glm::cross(b - a, d - a);
    gl.Normal3d(n.x, n.y, n.z);
    for (const glm::dvec3& p : {a, b, c, d}) gl.Vertex3d(p.x, p.y, p.z);
}

/// An open box with walls of 0.1 and half edge 0.6, its opening at +z.
inline void draw_cup(const GlTable& gl) {
    constexpr double o = 0.6, i = 0.5;
    gl.Begin(GL_QUADS);
    for (int side = 0; side < 4; ++side) {
        const auto at = [side](double r, double across, double z) {
            const glm::dvec2 p[] = {{r, across}, {-across, r}, {-r, -across}, {across, -r}};
            return glm::dvec3(p[side], z);
        };
        quad(gl, at(o, -o, -o), at(o, o, -o), at(o, o, o), at(o, -o, o));
        quad(gl, at(i, i, -i), at(i, -i, -i), at(i, -i, o), at(i, i, o));
        quad(gl, at(o, -o, o), at(o, o, o), at(i, i, o), at(i, -i, o));
    }
    quad(gl, {-o, o, -o}, {o, o, -o}, {o, -o, -o}, {-o, -o, -o});
    quad(gl, {-i, -i, -i}, {i, -i, -i}, {i, i, -i}, {-i, i, -i});
    gl.End();
}

/// A square through the origin, `parts` x `parts` quads, its normal turned from z by `degrees` about x.
inline void draw_sheet(const GlTable& gl, double degrees, int parts) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    const auto at = [&](int i, int j) {
        const double u = 1.4 * i / parts - 0.7, v = 1.4 * j / parts - 0.7;
        return glm::dvec3(u, v * c, v * s);
    };
    gl.Begin(GL_QUADS);
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) quad(gl, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    gl.End();
}

} // namespace glcast::test
