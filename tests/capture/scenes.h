// Small scenes to capture, and what is needed to check what came of them.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "capture/engine.h"

namespace glcast::test {

/// Triangles in immediate mode with exact normals, after `parallels` x 2 `parallels` quads.
void draw_sphere(const GlTable& gl, glm::dvec3 centre, double radius, int parallels = 48);

/// An axis-aligned box; face k (-x +x -y +y -z +z) gets colours[k % colours.size()] by glColor.
void draw_box(const GlTable& gl, glm::dvec3 lo, glm::dvec3 hi, const std::vector<glm::vec3>& colours);
void draw_box(const GlTable& gl, glm::dvec3 lo, glm::dvec3 hi);

/// Depth test, lighting with light 0, normalised normals, as most programs have it.
void set_lit(const GlTable& gl);
void set_diffuse(const GlTable& gl, glm::vec3 colour, GLenum name = GL_DIFFUSE,
                 GLenum face = GL_FRONT_AND_BACK);

/// A capture with everything that came out.
struct Cast {
    EngineReport report;
    std::vector<ViewImage> images; ///< -x +x -y +y -z +z, and their layers

    const ViewImage& view(Axis axis, Side side) const; ///< layer 0
    const ViewImage* find(const View& view) const;     ///< null when it is not there
};
Cast capture(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options);
EngineOptions small_options(int n = 64); ///< only the six views

/// The pixel of a view whose ray is nearest to a point.
std::size_t pixel_of(const Box& box, int n, Axis axis, glm::dvec3 point);

/// Degrees between two vectors.
double angle_between(glm::dvec3 a, glm::dvec3 b);

/// Largest differences of two captures of the same box.
struct Difference {
    double depth = 0, colour = 0, normal = 0;
    long coverage = 0; ///< pixels covered, or with a normal, in only one of them
};
Difference difference(const Cast& a, const Cast& b);

} // namespace glcast::test
