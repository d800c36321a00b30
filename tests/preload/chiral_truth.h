// A capture against the three boxes of programs/chiral.c: hit by hit, and which hand they are of.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/io/capture_reader.h"

namespace glcast::test {

inline double distance_to_box(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 lo = glm::min(a, b), hi = glm::max(a, b);
    const glm::dvec3 outside = glm::max(glm::max(lo - p, p - hi), 0.0);
    const glm::dvec3 inside = glm::min(p - lo, hi - p);
    const double depth = std::min({inside.x, inside.y, inside.z});
    return depth > 0 ? depth : glm::length(outside);
}

/// `scale`: capture coordinates of a point of the boxes are this times it.
inline void expect_chiral_boxes(const Capture& capture, const glm::dvec3& scale, double samples = 0.01) {
    const glm::dvec3 boxes[3][2] = {{{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};
    const double sample = capture.info.box.size / capture.info.n;
    long hits[3] = {}, wrong_normals = 0, all = 0;
    for (const ViewImage& image : capture.images) {
        for (int j = 0; j < image.n; ++j) {
            for (int i = 0; i < image.n; ++i) {
                const std::size_t at = std::size_t(j) * image.n + i;
                if (!image.covered(at)) continue;
                const glm::dvec3 p =
                    lattice_point(capture.info.box, image.n, image.view.axis, i, j, image.depth[at]);
                double nearest = 1e9;
                for (int b = 0; b < 3; ++b) {
                    const double d = distance_to_box(p, boxes[b][0] * scale, boxes[b][1] * scale);
                    hits[b] += d < samples * sample;
                    nearest = std::min(nearest, d);
                }
                ASSERT_LT(nearest, samples * sample) << p.x << ' ' << p.y << ' ' << p.z;
                ++all;
                // From outside, the drawn normal looks back along the ray: right side out.
                const double towards = image.normal[at][static_cast<int>(image.view.axis)] *
                                       (image.view.side == Side::plus ? 1 : -1);
                wrong_normals += image.view.layer == 0 && image.normal[at].w > 0 && towards < 0.9;
            }
        }
    }
    EXPECT_GT(all, 1000);
    EXPECT_EQ(wrong_normals, 0);
    for (const long hit : hits) EXPECT_GT(hit, 100);
}

} // namespace glcast::test
