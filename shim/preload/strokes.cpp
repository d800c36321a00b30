#include "shim/preload/strokes.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "shim/preload/feedback_pass.h"

namespace glcast::preload {
namespace {

constexpr int vertex_floats = 7; // GL_3D_COLOR with RGBA

glm::vec4 colour(const GLfloat* v) { return glm::make_vec4(v + 3); }

std::vector<Stroke> read_strokes(const std::vector<GLfloat>& values, const FeedbackLattice& lattice) {
    std::vector<Stroke> strokes;
    const GLfloat *at = values.data(), *end = at + values.size();
    while (at < end) {
        const auto token = static_cast<GLenum>(*at++);
        if (token == GL_POINT_TOKEN) {
            strokes.push_back({lattice.point(at), lattice.point(at), colour(at), colour(at)});
            at += vertex_floats;
        } else if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) {
            const GLfloat* to = at + vertex_floats;
            strokes.push_back({lattice.point(at), lattice.point(to), colour(at), colour(to)});
            at += 2 * vertex_floats;
        } else if (token == GL_POLYGON_TOKEN) {
            at += 1 + static_cast<std::size_t>(*at) * vertex_floats;
        } else if (token == GL_PASS_THROUGH_TOKEN) {
            ++at;
        } else {
            at += vertex_floats; // a bitmap or an image, at its raster position
        }
    }
    return strokes;
}

/// Everything that would change colours or cut something off.
void reset_state(const GlTable& gl) {
    GLint units = 1, planes = 6;
    if (gl.ActiveTexture) gl.GetIntegerv(GL_MAX_TEXTURE_UNITS, &units);
    gl.GetIntegerv(GL_MAX_CLIP_PLANES, &planes);
    for (GLint unit = units - 1; unit >= 0; --unit) {
        if (gl.ActiveTexture) gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        for (const GLenum cap : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP})
            gl.Disable(cap);
    }
    for (GLint plane = 0; plane < planes; ++plane) gl.Disable(GL_CLIP_PLANE0 + static_cast<GLenum>(plane));
    for (const GLenum cap :
         {GL_LIGHTING, GL_ALPHA_TEST, GL_BLEND, GL_CULL_FACE, GL_POLYGON_STIPPLE, GL_COLOR_SUM})
        gl.Disable(cap);
    gl.ShadeModel(GL_SMOOTH);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DrawBuffer(GL_COLOR_ATTACHMENT0);
}

/// The ends of the prism: four corners about each, turned counter-clockwise when seen from `to`.
std::array<glm::dvec3, 8> prism(const Stroke& stroke, double half) {
    glm::dvec3 along = stroke.to - stroke.from;
    const double length = glm::length(along);
    along = length > 1e-9 * half ? along / length : glm::dvec3(0, 0, 1);
    const glm::dvec3 a = glm::abs(along);
    const glm::dvec3 off = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                           : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                    : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = glm::normalize(glm::cross(along, off)) * half, v = glm::cross(along, u);
    const glm::dvec3 from = stroke.from - along * half, to = stroke.to + along * half;
    return {from - u - v, from + u - v, from + u + v, from - u + v,
            to - u - v,   to + u - v,   to + u + v,   to - u + v};
}

void draw_stroke(const Stroke& stroke, double half, const GlTable& gl) {
    constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    const auto corners = prism(stroke, half);
    for (const auto& face : faces)
        for (const int corner : face) {
            gl.Color4fv(glm::value_ptr(corner < 4 ? stroke.from_colour : stroke.to_colour));
            gl.Vertex3dv(glm::value_ptr(corners[corner]));
        }
}

} // namespace

std::vector<Stroke> collect_strokes(const GlTable& gl, const DrawFunction& draw,
                                    const EngineOptions& options) {
    return read_strokes(feed_back(gl, draw, options, GL_3D_COLOR), FeedbackLattice(*options.box));
}

void draw_strokes(const std::vector<Stroke>& strokes, double half_width, const glm::dmat4& eye_to_capture,
                  const GlTable& gl) {
    if (strokes.empty()) return;
    reset_state(gl);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadMatrixd(glm::value_ptr(glm::inverse(eye_to_capture)));
    gl.Begin(GL_QUADS);
    for (const Stroke& stroke : strokes) draw_stroke(stroke, half_width, gl);
    gl.End();
}

} // namespace glcast::preload
