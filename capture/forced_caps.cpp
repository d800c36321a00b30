#include "capture/forced_caps.h"

#include <algorithm>

namespace glcast {

namespace {

using enum CapPolicy;

struct CapRule {
    GLenum first;
    int count;
    bool per_texture_unit;
    CapPolicy colour, normal;
    const char* why;
};

// A cap decides where the surface is (kept), what it looks like (kept in the colour pass), or only how the
// program showed it on its screen (off). What is not here is kept.
constexpr CapRule rules[] = {
    {GL_CLIP_PLANE0, 8, false, keep, keep, "the program's own cut"},
    {GL_NORMALIZE, 1, false, keep, keep, "normals as drawn"},
    {GL_RESCALE_NORMAL, 1, false, keep, keep, "normals as drawn"},
    {GL_AUTO_NORMAL, 1, false, keep, keep, "normals of evaluators"},
    {GL_MAP1_COLOR_4, 9, false, keep, keep, "evaluators"},
    {GL_MAP2_COLOR_4, 9, false, keep, keep, "evaluators"},
    {GL_TEXTURE_GEN_S, 4, true, keep, keep, "texture coordinates"},
    {GL_TEXTURE_1D, 1, true, keep, off, "normals have no texture"},
    {GL_TEXTURE_2D, 1, true, keep, off, "normals have no texture"},
    {GL_TEXTURE_3D, 1, true, keep, off, "normals have no texture"},
    {GL_TEXTURE_CUBE_MAP, 1, true, keep, off, "normals have no texture"},
    {GL_TEXTURE_RECTANGLE, 1, true, keep, off, "normals have no texture"},
    {GL_COLOR_SUM, 1, false, keep, off, "the secondary colour is not a normal"},
    {GL_VERTEX_PROGRAM_ARB, 1, false, keep, off, "a program's lights are not ours"},
    {GL_FRAGMENT_PROGRAM_ARB, 1, false, keep, off, "a program's colours are not normals"},
    {GL_FRAGMENT_SHADER_ATI, 1, false, keep, off, "a program's colours are not normals"},
    {GL_LIGHTING, 1, false, keep, track, "unlit draws have no normal"},
    {GL_LIGHT0, 8, false, off, engine, "ambient light only; six lights of ours"},
    {GL_COLOR_MATERIAL, 1, false, track, off, "mapped with its mode; white"},
    {GL_ALPHA_TEST, 1, false, track, track, "holes stay holes"},
    {GL_BLEND, 1, false, track, track,
     "what lets half of the background through is not solid; the program's among equals"},
    {GL_DEPTH_TEST, 1, false, engine, engine, "one for each side"},
    {GL_STENCIL_TEST, 1, false, engine, engine, "it tells which fragments count"},
    {GL_STENCIL_TEST_TWO_SIDE_EXT, 1, false, off, off, "it tells which fragments count"},
    {GL_DEPTH_BOUNDS_TEST_EXT, 1, false, off, off, "depth is ours"},
    {GL_DEPTH_CLAMP, 1, false, off, off, "what is outside the box is not in it"},
    {GL_SCISSOR_TEST, 1, false, off, off, "all of the lattice"},
    {GL_CULL_FACE, 1, false, off, off, "both sides of every polygon"},
    {GL_POLYGON_OFFSET_FILL, 1, false, track, track, "exact depth; which of coplanar surfaces is seen"},
    {GL_POLYGON_OFFSET_LINE, 1, false, off, off, "exact depth"},
    {GL_POLYGON_OFFSET_POINT, 1, false, off, off, "exact depth"},
    {GL_POLYGON_STIPPLE, 1, false, off, off, "whole polygons"},
    {GL_POLYGON_SMOOTH, 1, false, off, off, "whole pixels"},
    {GL_FOG, 1, false, off, off, "colour of the surface"},
    {GL_DITHER, 1, false, off, off, "colour of the surface"},
    {GL_COLOR_LOGIC_OP, 1, false, track, track, "colour of the surface; blending is off while it is on"},
    {GL_INDEX_LOGIC_OP, 1, false, off, off, "colour of the surface"},
    {GL_FRAMEBUFFER_SRGB, 1, false, off, off, "colour as drawn, not converted"},
    {GL_MULTISAMPLE, 1, false, off, off, "one sample a pixel, at its centre"},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, 1, false, off, off, "one sample a pixel"},
    {GL_SAMPLE_ALPHA_TO_ONE, 1, false, off, off, "one sample a pixel"},
    {GL_SAMPLE_COVERAGE, 1, false, off, off, "one sample a pixel"},
    {GL_SAMPLE_SHADING, 1, false, off, off, "one sample a pixel"},
    {GL_SAMPLE_MASK, 1, false, off, off, "one sample a pixel"},
    {GL_RASTERIZER_DISCARD, 1, false, off, off, "everything is drawn"},
};

bool has(const CapRule& rule, GLenum cap) {
    return cap >= rule.first && cap < rule.first + static_cast<GLenum>(rule.count);
}

/// What marks the program's stencil buffer, and where (program_stencil.h).
bool is_of_stencil(GLenum cap) {
    return cap == GL_STENCIL_TEST || cap == GL_STENCIL_TEST_TWO_SIDE_EXT || cap == GL_CULL_FACE;
}

void reset(const GlTable& gl, bool per_texture_unit) {
    for (const CapRule& rule : rules) {
        if (rule.per_texture_unit != per_texture_unit || rule.colour == engine) continue;
        for (int i = 0; i < rule.count; ++i) gl.Disable(rule.first + i);
    }
}

} // namespace

CapPolicy cap_policy(GLenum cap, PassKind kind) {
    const auto* rule =
        std::find_if(std::begin(rules), std::end(rules), [cap](const CapRule& r) { return has(r, cap); });
    if (rule == std::end(rules)) return keep;
    if (kind == PassKind::stencil && is_of_stencil(cap)) return keep;
    return kind == PassKind::normal ? rule->normal : rule->colour;
}

void reset_caps(const GlTable& gl) {
    reset(gl, false);
    GLint units = 1;
    gl.GetIntegerv(GL_MAX_TEXTURE_UNITS, &units);
    for (GLint unit = gl.ActiveTexture ? units - 1 : 0; unit >= 0; --unit) {
        if (gl.ActiveTexture) gl.ActiveTexture(GL_TEXTURE0 + unit);
        reset(gl, true);
    }
}

} // namespace glcast
