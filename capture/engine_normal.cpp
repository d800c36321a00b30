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

PixelRect drawn_part(const Pass& pass, const Target& target) {
    return pass.only.value_or(PixelRect::whole(target.size()));
}

/// One render: the lights' colours add up to the normal.
void paint_signed(PassRunner& passes, const Target& target, Pass pass, Pixels& normals) {
    pass.lights = target.float_colour() ? Lights::signed_colour : Lights::half_colour;
    passes.run(pass, target);
    target.read_colour(normals, pass.only);
    if (target.float_colour()) return;
    for_each_pixel(drawn_part(pass, target), target.size(), [&](std::size_t p) {
        normals[p] = glm::vec4(glm::vec3(normals[p]) * 2.0f - 1.0f, normals[p].a);
    });
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
        target.read_colour(front, pass.only);
        pass.light = 2 * axis + 1;
        passes.run(pass, target);
        target.read_colour(back, pass.only);
        normals.resize(front.size());
        for_each_pixel(drawn_part(pass, target), target.size(), [&](std::size_t p) {
            normals[p][axis] = front[p].r - back[p].r;
            normals[p].a = front[p].a;
        });
    }
}

void paint(PassRunner& passes, const Target& target, const Pass& pass, NormalMethod method, Pixels& normals) {
    if (method == NormalMethod::six_lights)
        paint_six(passes, target, pass, normals);
    else
        paint_signed(passes, target, pass, normals);
}

/// True when a covered pixel still has no draw behind it.
bool any_missed(const ViewImage& image, const PixelRect& part) {
    return !bounds_of(part, image.n, [&](std::size_t p) {
                return image.covered(p) && drawn(image.normal[p].a) == Drawn::missed;
            }).empty();
}

/// Where no fragment had the depth of the colour pass to the bit, take the first one that is within half a
/// sample of it.
void fill_missed(PassRunner& passes, const Target& target, Pass pass, NormalMethod method, ViewImage& image) {
    pass.depth = DepthRule::missed;
    pass.open = nullptr;
    Pixels second;
    std::vector<float> depth;
    paint(passes, target, pass, method, second);
    target.read_depth(depth, pass.only);
    const float tolerance = 0.5f / image.n;
    for_each_pixel(drawn_part(pass, target), image.n, [&](std::size_t p) {
        if (!image.covered(p) || drawn(image.normal[p].a) != Drawn::missed) return;
        if (std::abs(depth[p] - image.depth[p]) <= tolerance) image.normal[p] = second[p];
    });
}

/// Alpha told how the pixel was drawn; from here on it tells whether there is a normal.
void mark_normals(ViewImage& image, const PixelRect& part) {
    constexpr float shortest = 1e-6f;
    for_each_pixel(part, image.n, [&](std::size_t p) {
        glm::vec4& normal = image.normal[p];
        const bool there =
            image.covered(p) && drawn(normal.a) == Drawn::lit && glm::length(glm::vec3(normal)) > shortest;
        normal = there ? glm::vec4(glm::vec3(normal), 1) : glm::vec4(0);
    });
}

} // namespace

void capture_normals(PassRunner& passes, const Target& target, const Pass& view, NormalMethod method,
                     ViewImage& image) {
    Pass pass = view;
    pass.kind = PassKind::normal;
    pass.depth = DepthRule::equal;
    paint(passes, target, pass, method, image.normal);
    // Before an inner layer lies what is seen from outside, so only layer 0 can be found without equal depth.
    const PixelRect part = drawn_part(pass, target);
    if (image.view.layer == 0 && any_missed(image, part)) fill_missed(passes, target, pass, method, image);
    mark_normals(image, part);
}

} // namespace glcast
