#include "tests/reconstruct/hollow_bodies.h"

namespace glcast::test {
namespace {

using glm::dvec3;

const glm::dmat3 tilt40 = turned({1, 0.3, 0.2}, 40);

BodyPtr cup() {
    const dvec3 up = tilt40[2];
    return subtract(cylinder({0, 0, 0}, up, 0.6, 0.6), cylinder(up * 0.12, up, 0.48, 0.6, {1, 0, 0}));
}

/// Three quarters of a hollow ring: its middle is seen from neither end.
BodyPtr bent_tube() {
    const glm::dmat3 turn = turned({1, 2, 0.5}, 30);
    const dvec3 axis = turn[2];
    const BodyPtr wall =
        subtract(torus({0, 0, 0}, axis, 0.55, 0.3), torus({0, 0, 0}, axis, 0.55, 0.2, {1, 0, 0}));
    return subtract(wall, box(turn * dvec3(1, 1, 0), dvec3(1, 1, 1), turn));
}

BodyPtr bracket() {
    const BodyPtr plates = unite({box({0, 0, -0.45}, {0.8, 0.6, 0.2}), box({-0.6, 0, 0.1}, {0.2, 0.6, 0.7})});
    const dvec3 lean = turned({0, 1, 0}, 35)[2], side = turned({1, 0, 0.4}, 25)[0];
    return subtract(subtract(plates, cylinder({0.3, 0.1, -0.45}, lean, 0.15, 1.5, {1, 0, 0})),
                    cylinder({-0.6, 0, 0.4}, side, 0.12, 1.5, {0, 1, 0}));
}

BodyPtr fins() {
    const glm::dmat3 turn = turned({1, 2, 3}, 25);
    std::vector<BodyPtr> parts{box(turn * dvec3(0, 0, -0.5), {0.7, 0.5, 0.08}, turn)};
    for (int i = 0; i < 6; ++i)
        parts.push_back(box(turn * dvec3(-0.6 + 0.24 * i, 0, 0), {0.04, 0.5, 0.5}, turn));
    return unite(parts);
}

BodyPtr sphere_in_box() {
    const glm::dmat3 turn = turned({1, 2, 3}, 25);
    return unite({subtract(box({0, 0, 0}, dvec3(0.6), turn), box({0, 0, 0}, dvec3(0.5), turn)),
                  sphere({0, 0, 0}, 0.35, {1, 0, 0})});
}

/// Open windows on both sides; a slit around the bonnet, a tenth of the windows' height; an engine that only
/// the slit shows, a seat behind the windows.
BodyPtr car() {
    BodyPtr shell =
        subtract(unite({box({0, 0, -0.2}, {0.9, 0.45, 0.25}), box({-0.1, 0, 0.25}, {0.5, 0.4, 0.25})}),
                 unite({box({0, 0, -0.2}, {0.85, 0.4, 0.2}), box({-0.1, 0, 0.2}, {0.45, 0.35, 0.25})}));
    shell = subtract(shell, box({-0.1, 0, 0.27}, {0.3, 1, 0.14}));
    shell = subtract(shell, box({0.62, 0, 0.04}, {0.01, 0.3, 0.05}));
    shell = unite({shell, box({0.43, 0, -0.2}, {0.03, 0.43, 0.24})});
    return unite({shell, box({0.66, 0, -0.25}, {0.1, 0.2, 0.1}, glm::dmat3(1), {1, 0, 0}),
                  box({-0.2, 0, -0.2}, {0.12, 0.12, 0.15}, glm::dmat3(1), {0, 1, 0})});
}

BodyPtr bottle() {
    const glm::dmat3 turn = turned({1, 1, 0}, 20);
    const dvec3 up = turn[2];
    const BodyPtr outer = unite({cylinder(up * -0.3, up, 0.5, 0.5), cylinder(up * 0.45, up, 0.13, 0.35)});
    const BodyPtr inner = unite({cylinder(up * -0.3, up, 0.42, 0.42), cylinder(up * 0.5, up, 0.06, 0.45)});
    return subtract(outer, inner);
}

} // namespace

std::vector<HollowBody> hollow_bodies() {
    return {{"cup", cup()},      {"bent_tube", bent_tube()},         {"bracket", bracket()},
            {"fins", fins()},    {"sphere_in_box", sphere_in_box()}, {"car", car()},
            {"bottle", bottle()}};
}

} // namespace glcast::test
