#include "capture/engine_normal.h"

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace glcast {

namespace {

using Pixels = std::vector<glm::vec4>;

enum class Drawn { missed, unlit, lit };

Drawn drawn(float alpha) {
    if (alpha > 0.5f * (lit_alpha + unlit_alpha)) return Drawn::lit;
    return alpha > 0.5f * (unlit_alpha + missed_alpha) ? Drawn::unlit : Drawn::missed;
}

/// One render: the lights' colours add up to the normal.
void paint_signed(PassRunner& passes, const Target& target, Pass pass, Pixels& normals) {
    pass.lights = target.float_colour() ? Lights::signed_colour : Lights::half_colour;
    passes.run(pass, target);
    target.read_colour(normals);
    if (target.float_colour()) return;
    for (glm::vec4& pixel : normals) pixel = glm::vec4(glm::vec3(pixel) * 2.0f - 1.0f, pixel.a);
}

/// The paper's six: opposite lights give the positive and the negative part of a component. The paper takes
/// the one that is not 0; inside a polygon that the terminator crosses neither is, and there their difference
/// is right.
void paint_six(PassRunner& passes, const Target& target, Pass pass, Pixels& normals) {
    pass.lights = Lights::single;
    Pixels front, back;
    for (int axis = 0; axis < 3; ++axis) {
        pass.light = 2 * axis;
        passes.run(pass, target);
        target.read_colour(front);
        pass.light = 2 * axis + 1;
        passes.run(pass, target);
        target.read_colour(back);
        if (axis == 0) normals = front; // and its alpha
        for (std::size_t i = 0; i < normals.size(); ++i) normals[i][axis] = front[i].r - back[i].r;
    }
}

void paint(PassRunner& passes, const Target& target, const Pass& pass, NormalMethod method, Pixels& normals) {
    if (method == NormalMethod::six_lights)
        paint_six(passes, target, pass, normals);
    else
        paint_signed(passes, target, pass, normals);
}

/// True when a covered pixel still has no draw behind it.
bool any_missed(const ViewImage& image) {
    for (std::size_t i = 0; i < image.normal.size(); ++i)
        if (image.covered(i) && drawn(image.normal[i].a) == Drawn::missed) return true;
    return false;
}

/// Where no fragment had the depth of the colour pass to the bit, take the first one that is within half a
/// sample of it.
void fill_missed(PassRunner& passes, const Target& target, Pass pass, NormalMethod method, ViewImage& image) {
    pass.depth = DepthRule::missed;
    Pixels second;
    std::vector<float> depth;
    paint(passes, target, pass, method, second);
    target.read_depth(depth);
    const float tolerance = 0.5f / image.n;
    for (std::size_t i = 0; i < second.size(); ++i) {
        if (!image.covered(i) || drawn(image.normal[i].a) != Drawn::missed) continue;
        if (std::abs(depth[i] - image.depth[i]) <= tolerance) image.normal[i] = second[i];
    }
}

/// Alpha told how the pixel was drawn; from here on it tells whether there is a normal.
void mark_normals(ViewImage& image) {
    constexpr float shortest = 1e-6f;
    for (std::size_t i = 0; i < image.normal.size(); ++i) {
        glm::vec4& normal = image.normal[i];
        const bool there =
            image.covered(i) && drawn(normal.a) == Drawn::lit && glm::length(glm::vec3(normal)) > shortest;
        normal = there ? glm::vec4(glm::vec3(normal), 1) : glm::vec4(0);
    }
}

} // namespace

void capture_normals(PassRunner& passes, const Target& target, const Pass& view, NormalMethod method,
                     ViewImage& image) {
    Pass pass = view;
    pass.kind = PassKind::normal;
    pass.depth = DepthRule::equal;
    paint(passes, target, pass, method, image.normal);
    // Before an inner layer lies what is seen from outside, so only layer 0 can be found without equal depth.
    if (image.view.layer == 0 && any_missed(image)) fill_missed(passes, target, pass, method, image);
    mark_normals(image);
}

} // namespace glcast
