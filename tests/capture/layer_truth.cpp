#include "tests/capture/layer_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glcast::test {
namespace {

void add(std::vector<Hit>& hits, const ViewImage& image, std::size_t pixel) {
    if (image.covered(pixel))
        hits.push_back({image.depth[pixel], glm::dvec3(image.normal[pixel]), glm::vec3(image.colour[pixel])});
}

class Cylinder : public Body {
  public:
    Cylinder(glm::dvec3 foot, double radius, double height, glm::vec3 colour)
        : foot(foot), radius(radius), height(height), colour(colour) {}

    std::vector<Stretch> cut(const glm::dvec3& p, const glm::dvec3& d) const override {
        const glm::dvec3 o = p - foot;
        double t0 = -1e9, t1 = 1e9;
        glm::dvec3 n0(0), n1(0);
        const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y,
                     c = o.x * o.x + o.y * o.y - radius * radius;
        if (a < 1e-12 ? c >= 0 : b * b <= a * c) return {};
        if (a >= 1e-12) {
            const double root = std::sqrt(b * b - a * c);
            t0 = (-b - root) / a, t1 = (-b + root) / a;
            n0 = side(o + d * t0), n1 = side(o + d * t1);
        }
        if (d.z == 0 ? o.z <= 0 || o.z >= height : false) return {};
        if (d.z != 0) {
            const double down = -o.z / d.z, up = (height - o.z) / d.z, enter = std::min(down, up),
                         leave = std::max(down, up);
            const glm::dvec3 end(0, 0, d.z > 0 ? 1 : -1);
            if (enter > t0) t0 = enter, n0 = -end;
            if (leave < t1) t1 = leave, n1 = end;
        }
        if (t0 >= t1) return {};
        return {{t0, t1, n0, n1, colour, colour}};
    }
    double distance(const glm::dvec3&) const override { return 0; } // not needed here

  private:
    glm::dvec3 side(const glm::dvec3& o) const { return {o.x / radius, o.y / radius, 0}; }
    glm::dvec3 foot;
    double radius, height;
    glm::vec3 colour;
};

} // namespace

std::vector<Hit> true_hits(const std::vector<BodyPtr>& bodies, const Box& box, int n, Axis axis,
                           std::size_t pixel) {
    const glm::dvec3 start = lattice_point(box, n, axis, int(pixel) % n, int(pixel) / n, 0);
    glm::dvec3 along(0);
    along[static_cast<int>(axis)] = 1;
    std::vector<Hit> hits;
    for (const BodyPtr& body : bodies)
        for (const Stretch& s : body->cut(start, along)) {
            hits.push_back({s.t0 / box.size, s.n0, s.c0});
            hits.push_back({s.t1 / box.size, s.n1, s.c1});
        }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    return hits;
}

std::vector<Hit> cast_hits(const Cast& cast, Axis axis, std::size_t pixel) {
    std::vector<Hit> hits;
    for (int layer = 0; const ViewImage* image = cast.find({axis, Side::minus, layer}); ++layer)
        add(hits, *image, pixel);
    add(hits, *cast.find({axis, Side::plus, 0}), pixel);
    if (hits.size() == 2 && hits[0].depth == hits[1].depth) hits.pop_back();
    return hits;
}

LayerErrors layer_errors(const Cast& cast, const std::vector<BodyPtr>& bodies) {
    LayerErrors e;
    const int n = cast.images.at(0).n;
    long compared = 0;
    for (Axis axis : {Axis::x, Axis::y, Axis::z})
        for (std::size_t pixel = 0; pixel < std::size_t(n) * n; ++pixel) {
            const std::vector<Hit> truth = true_hits(bodies, cast.report.box, n, axis, pixel),
                                   seen = cast_hits(cast, axis, pixel);
            e.rays += !truth.empty();
            e.hits += long(truth.size());
            e.wrong_count += truth.size() != seen.size();
            if (truth.size() != seen.size()) continue;
            for (std::size_t k = 0; k < truth.size(); ++k) {
                const double off = std::abs(truth[k].depth - seen[k].depth) * n *
                                   std::abs(truth[k].normal[static_cast<int>(axis)]); // along the normal
                e.depth_mean += off;
                e.depth_max = std::max(e.depth_max, off);
                e.normal_max = std::max(e.normal_max, angle_between(truth[k].normal, seen[k].normal));
                e.colour_max = std::max(e.colour_max, double(glm::distance(truth[k].colour, seen[k].colour)));
                ++compared;
            }
        }
    e.depth_mean /= double(std::max(compared, 1L));
    return e;
}

LayerDifference layer_difference(const Cast& a, const Cast& b) {
    LayerDifference d;
    const int n = a.images.at(0).n;
    for (Axis axis : {Axis::x, Axis::y, Axis::z})
        for (std::size_t pixel = 0; pixel < std::size_t(n) * n; ++pixel) {
            const std::vector<Hit> x = cast_hits(a, axis, pixel), y = cast_hits(b, axis, pixel);
            d.rays += !x.empty();
            d.wrong_count += x.size() != y.size();
            if (x.size() != y.size()) continue;
            for (std::size_t k = 0; k < x.size(); ++k) {
                d.depth = std::max(d.depth, std::abs(x[k].depth - y[k].depth) * n);
                d.colour = std::max(d.colour, double(glm::distance(x[k].colour, y[k].colour)));
                d.normal = std::max(d.normal, glm::distance(x[k].normal, y[k].normal));
            }
        }
    return d;
}

BodyPtr cylinder(glm::dvec3 foot, double radius, double height, glm::vec3 colour) {
    return std::make_shared<Cylinder>(foot, radius, height, colour);
}

void draw_cylinder(const GlTable& gl, glm::dvec3 foot, double radius, double height) {
    constexpr int quads = 96;
    const auto around = [](int k) {
        const double angle = 2 * std::numbers::pi * (k % quads) / quads;
        return glm::dvec3(std::cos(angle), std::sin(angle), 0);
    };
    const auto vertex = [&](glm::dvec3 p) { gl.Vertex3d(p.x, p.y, p.z); };
    const glm::dvec3 up(0, 0, height);
    gl.Begin(GL_QUAD_STRIP);
    for (int k = 0; k <= quads; ++k) {
        const glm::dvec3 n = around(k);
        gl.Normal3d(n.x, n.y, n.z);
        vertex(foot + n * radius), vertex(foot + n * radius + up);
    }
    gl.End();
    for (const bool top : {false, true}) {
        gl.Begin(GL_POLYGON);
        gl.Normal3d(0, 0, top ? 1 : -1);
        for (int k = 0; k < quads; ++k)
            vertex(foot + around(top ? k : quads - k) * radius + (top ? up : glm::dvec3(0)));
        gl.End();
    }
}

} // namespace glcast::test
