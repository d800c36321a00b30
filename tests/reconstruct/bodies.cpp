#include "tests/reconstruct/bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace glcast::test {
namespace {

using glm::dvec3;

class Sphere : public Body {
  public:
    Sphere(dvec3 centre, double radius, glm::vec3 colour) : centre(centre), radius(radius), colour(colour) {}
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        const dvec3 o = p - centre;
        const double b = glm::dot(o, d), q = b * b - glm::dot(o, o) + radius * radius;
        if (q <= 0) return {};
        const double r = std::sqrt(q), t0 = -b - r, t1 = -b + r;
        return {{t0, t1, (o + d * t0) / radius, (o + d * t1) / radius, colour, colour}};
    }
    double distance(const dvec3& p) const override { return glm::length(p - centre) - radius; }

  private:
    dvec3 centre;
    double radius;
    glm::vec3 colour;
};

class Torus : public Body {
  public:
    Torus(dvec3 centre, dvec3 axis, double ring, double tube, glm::vec3 colour)
        : centre(centre), axis(glm::normalize(axis)), ring(ring), tube(tube), colour(colour) {}
    double distance(const dvec3& p) const override {
        const dvec3 o = p - centre;
        const double up = glm::dot(o, axis), out = glm::length(o - axis * up);
        return std::hypot(out - ring, up) - tube;
    }
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        const double mid = glm::dot(centre - p, d), reach = ring + tube + 1e-9;
        if (glm::length(p + d * mid - centre) > reach) return {};
        std::vector<double> roots;
        const int steps = 400;
        double before = distance(p + d * (mid - reach));
        for (int i = 1; i <= steps; ++i) {
            const double t0 = mid - reach + 2 * reach * (i - 1) / steps,
                         t1 = mid - reach + 2 * reach * i / steps;
            const double after = distance(p + d * t1);
            if ((before < 0) != (after < 0)) roots.push_back(root(p, d, t0, t1, before));
            before = after;
        }
        std::vector<Stretch> out;
        for (std::size_t i = 0; i + 1 < roots.size(); i += 2)
            out.push_back({roots[i], roots[i + 1], normal(p + d * roots[i]), normal(p + d * roots[i + 1]),
                           colour, colour});
        return out;
    }

  private:
    double root(const dvec3& p, const dvec3& d, double t0, double t1, double at0) const {
        for (int k = 0; k < 60; ++k) {
            const double t = 0.5 * (t0 + t1);
            if ((distance(p + d * t) < 0) == (at0 < 0))
                t0 = t;
            else
                t1 = t;
        }
        return 0.5 * (t0 + t1);
    }
    dvec3 normal(const dvec3& p) const {
        const dvec3 o = p - centre, flat = o - axis * glm::dot(o, axis);
        return glm::normalize(o - glm::normalize(flat) * ring);
    }
    dvec3 centre, axis;
    double ring, tube;
    glm::vec3 colour;
};

class BoxBody : public Body {
  public:
    BoxBody(dvec3 centre, dvec3 half, glm::dmat3 turn, glm::vec3 colour)
        : centre(centre), half(half), turn(turn), colour(colour) {}
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        const dvec3 o = glm::transpose(turn) * (p - centre), e = glm::transpose(turn) * d;
        Stretch s{-1e300, 1e300, {}, {}, colour, colour};
        for (int k = 0; k < 3; ++k) {
            if (std::abs(e[k]) < 1e-12) {
                if (std::abs(o[k]) > half[k]) return {};
                continue;
            }
            const double sign = e[k] > 0 ? 1 : -1;
            const double in = (-sign * half[k] - o[k]) / e[k], out = (sign * half[k] - o[k]) / e[k];
            if (in > s.t0) s.t0 = in, s.n0 = turn[k] * -sign;
            if (out < s.t1) s.t1 = out, s.n1 = turn[k] * sign;
        }
        if (!(s.t0 <= s.t1)) return {};
        return {s};
    }
    double distance(const dvec3& p) const override {
        const dvec3 q = glm::abs(glm::transpose(turn) * (p - centre)) - half;
        const double out = glm::length(glm::max(q, dvec3(0)));
        return out > 0 ? out : std::max({q.x, q.y, q.z});
    }

  private:
    dvec3 centre, half;
    glm::dmat3 turn;
    glm::vec3 colour;
};

class Cylinder : public Body {
  public:
    Cylinder(dvec3 centre, dvec3 axis, double radius, double half, glm::vec3 colour)
        : centre(centre), axis(glm::normalize(axis)), radius(radius), half(half), colour(colour) {}
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        const dvec3 o = p - centre;
        const double up = glm::dot(o, axis), rise = glm::dot(d, axis);
        const dvec3 flat = o - axis * up, run = d - axis * rise;
        Stretch s{-1e300, 1e300, {}, {}, colour, colour};
        const double a = glm::dot(run, run), b = glm::dot(flat, run),
                     c = glm::dot(flat, flat) - radius * radius;
        if (a < 1e-14) {
            if (c > 0) return {};
        } else {
            const double q = b * b - a * c;
            if (q <= 0) return {};
            s.t0 = (-b - std::sqrt(q)) / a;
            s.t1 = (-b + std::sqrt(q)) / a;
            s.n0 = (flat + run * s.t0) / radius;
            s.n1 = (flat + run * s.t1) / radius;
        }
        if (std::abs(rise) < 1e-12) {
            if (std::abs(up) > half) return {};
        } else {
            const double sign = rise > 0 ? 1 : -1;
            const double in = (-sign * half - up) / rise, out = (sign * half - up) / rise;
            if (in > s.t0) s.t0 = in, s.n0 = -axis * sign;
            if (out < s.t1) s.t1 = out, s.n1 = axis * sign;
        }
        if (!(s.t0 < s.t1)) return {};
        return {s};
    }
    double distance(const dvec3& p) const override {
        const dvec3 o = p - centre;
        const double up = glm::dot(o, axis);
        const double out = glm::length(o - axis * up) - radius, over = std::abs(up) - half;
        return out > 0 && over > 0 ? std::hypot(out, over) : std::max(out, over);
    }

  private:
    dvec3 centre, axis;
    double radius, half;
    glm::vec3 colour;
};

class Union : public Body {
  public:
    explicit Union(std::vector<BodyPtr> parts) : parts(std::move(parts)) {}
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        std::vector<Stretch> all;
        for (const auto& part : parts)
            for (const Stretch& s : part->cut(p, d)) all.push_back(s);
        std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.t0 < b.t0; });
        std::vector<Stretch> out;
        for (const Stretch& s : all) {
            if (out.empty() || s.t0 > out.back().t1)
                out.push_back(s);
            else if (s.t1 > out.back().t1)
                out.back().t1 = s.t1, out.back().n1 = s.n1, out.back().c1 = s.c1;
        }
        return out;
    }
    double distance(const dvec3& p) const override {
        double least = 1e300;
        for (const auto& part : parts) least = std::min(least, part->distance(p));
        return least;
    }

  private:
    std::vector<BodyPtr> parts;
};

class Difference : public Body {
  public:
    Difference(BodyPtr from, BodyPtr what) : from(std::move(from)), what(std::move(what)) {}
    std::vector<Stretch> cut(const dvec3& p, const dvec3& d) const override {
        std::vector<Stretch> out = from->cut(p, d);
        for (const Stretch& hole : what->cut(p, d)) {
            std::vector<Stretch> next;
            for (const Stretch& s : out) {
                if (hole.t1 <= s.t0 || hole.t0 >= s.t1) {
                    next.push_back(s);
                    continue;
                }
                if (hole.t0 > s.t0) next.push_back({s.t0, hole.t0, s.n0, -hole.n0, s.c0, hole.c0});
                if (hole.t1 < s.t1) next.push_back({hole.t1, s.t1, -hole.n1, s.n1, hole.c1, s.c1});
            }
            out = next;
        }
        return out;
    }
    double distance(const dvec3& p) const override { return std::max(from->distance(p), -what->distance(p)); }

  private:
    BodyPtr from, what;
};

/// Start and direction of the ray of pixel (i, j); t is then the depth times the box's size.
dvec3 ray_start(const Box& box, int n, Axis axis, double i, double j) {
    const ImageAxes axes = image_axes(axis);
    dvec3 p = box.lo;
    p[axes.u] += (i + 0.5) / n * box.size;
    p[axes.v] += (j + 0.5) / n * box.size;
    return p;
}

dvec3 ray_direction(Axis axis) {
    dvec3 d(0);
    d[static_cast<int>(axis)] = 1;
    return d;
}

} // namespace

BodyPtr sphere(dvec3 centre, double radius, glm::vec3 colour) {
    return std::make_shared<Sphere>(centre, radius, colour);
}
BodyPtr torus(dvec3 centre, dvec3 axis, double ring, double tube, glm::vec3 colour) {
    return std::make_shared<Torus>(centre, axis, ring, tube, colour);
}
BodyPtr box(dvec3 centre, dvec3 half, glm::dmat3 turn, glm::vec3 colour) {
    return std::make_shared<BoxBody>(centre, half, turn, colour);
}
BodyPtr cylinder(dvec3 centre, dvec3 axis, double radius, double half, glm::vec3 colour) {
    return std::make_shared<Cylinder>(centre, axis, radius, half, colour);
}
BodyPtr unite(std::vector<BodyPtr> parts) { return std::make_shared<Union>(std::move(parts)); }
BodyPtr subtract(BodyPtr from, BodyPtr what) {
    return std::make_shared<Difference>(std::move(from), std::move(what));
}
glm::dmat3 turned(dvec3 axis, double degrees) {
    return glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), axis));
}

std::vector<ViewImage> cast_layers(const Body& body, const Box& box, int n, const NormalEdit& edit) {
    std::vector<ViewImage> images;
    for (int a = 0; a < 3; ++a) {
        std::vector<ViewImage> layers{blank_image({Axis(a), Side::minus, 0}, n),
                                      blank_image({Axis(a), Side::plus, 0}, n)};
        const dvec3 d = ray_direction(Axis(a));
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const dvec3 p = ray_start(box, n, Axis(a), i, j);
                const auto stretches = body.cut(p, d);
                const std::size_t at = std::size_t(j) * n + i, ends = 2 * stretches.size();
                for (std::size_t k = 0; k < ends; ++k) {
                    const Stretch& s = stretches[k / 2];
                    const double t = k % 2 ? s.t1 : s.t0;
                    dvec3 normal = k % 2 ? s.n1 : s.n0;
                    if (edit) normal = edit(p + d * t, normal);
                    const std::size_t layer = k == 0 ? 0 : k + 1 == ends ? 1 : k + 1; // 0, 1: the outer views
                    while (layers.size() <= layer)
                        layers.push_back(blank_image({Axis(a), Side::minus, int(layers.size()) - 1}, n));
                    ViewImage& image = layers[layer];
                    image.depth[at] =
                        float(std::clamp(t / box.size, 0.0, 1.0)); // cut by the near and far planes
                    image.colour[at] = glm::vec4(k % 2 ? s.c1 : s.c0, 1);
                    image.normal[at] = glm::vec4(glm::vec3(normal), 1);
                }
            }
        for (ViewImage& image : layers) images.push_back(std::move(image));
    }
    return images;
}

std::vector<ViewImage> cast_body(const Body& body, const Box& box, int n, const NormalEdit& edit) {
    std::vector<ViewImage> images = cast_layers(body, box, n, edit);
    std::erase_if(images, [](const ViewImage& image) { return image.view.layer > 0; });
    return images;
}

std::vector<ViewImage> noise_images(int n, std::mt19937& random, double coverage) {
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<ViewImage> images;
    for (int a = 0; a < 3; ++a) {
        ViewImage near = blank_image({Axis(a), Side::minus, 0}, n),
                  far = blank_image({Axis(a), Side::plus, 0}, n);
        for (std::size_t p = 0; p < near.depth.size(); ++p) {
            if (unit(random) > coverage) continue;
            const float x = unit(random), y = unit(random);
            near.depth[p] = std::min(x, y);
            far.depth[p] = std::max(x, y);
            for (ViewImage* image : {&near, &far}) {
                image->colour[p] = {unit(random), unit(random), unit(random), 1};
                image->normal[p] = {unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f, 1};
            }
        }
        images.push_back(std::move(near));
        images.push_back(std::move(far));
    }
    return images;
}

std::vector<dvec3> surface_points(const Body& body, const Box& box, int rays_per_axis) {
    std::vector<dvec3> points;
    for (int a = 0; a < 3; ++a)
        for (int j = 0; j < rays_per_axis; ++j)
            for (int i = 0; i < rays_per_axis; ++i) {
                const dvec3 p = ray_start(box, rays_per_axis, Axis(a), i, j), d = ray_direction(Axis(a));
                const auto stretches = body.cut(p, d);
                if (stretches.empty()) continue;
                points.push_back(p + d * stretches.front().t0);
                points.push_back(p + d * stretches.back().t1);
            }
    return points;
}

std::vector<dvec3> visible_points(const Body& body, const Box& box, int rays_per_axis, int directions) {
    std::vector<dvec3> points;
    const auto visible = [&](const dvec3& p, const dvec3& normal) {
        for (int k = 0; k < directions; ++k) {
            const double z = 1 - (2 * k + 1.0) / directions, angle = k * 2.399963229728653;
            const dvec3 d(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
            if (glm::dot(d, normal) < 0.05) continue;
            const auto stretches = body.cut(p + normal * (1e-6 * box.size), d);
            if (std::none_of(stretches.begin(), stretches.end(), [](auto& s) { return s.t1 > 0; }))
                return true;
        }
        return false;
    };
    for (int a = 0; a < 3; ++a)
        for (int j = 0; j < rays_per_axis; ++j)
            for (int i = 0; i < rays_per_axis; ++i) {
                const dvec3 p = ray_start(box, rays_per_axis, Axis(a), i, j), d = ray_direction(Axis(a));
                for (const Stretch& s : body.cut(p, d)) {
                    if (visible(p + d * s.t0, s.n0)) points.push_back(p + d * s.t0);
                    if (visible(p + d * s.t1, s.n1)) points.push_back(p + d * s.t1);
                }
            }
    return points;
}

} // namespace glcast::test
