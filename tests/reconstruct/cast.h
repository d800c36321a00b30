// What the tests here share: a box a little off the origin, so that nothing falls on samples by luck.
#pragma once
#include <gtest/gtest.h>

#include "tests/reconstruct/bodies.h"
#include "tests/reconstruct/measure.h"
#include "tools/mesh/check.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast::test {

inline const Box test_box{glm::dvec3(-1.013, -1.007, -1.021), 2.04};
inline double sample_size(int n) { return test_box.size / n; }

/// Cast, reconstructed, and checked to be a closed two-manifold by two checks that did not make it, and not
/// to pass through itself.
struct Cast {
    Mesh mesh;
    ReconstructReport report;
};
inline Cast cast(const std::vector<ViewImage>& images, const ReconstructOptions& options = {}) {
    Cast out;
    out.mesh = reconstruct(images, test_box, options, &out.report);
    const Topology found = topology(out.mesh);
    EXPECT_TRUE(found.closed()) << found;
    const MeshCheck check = check_mesh(out.mesh, CheckDepth::everything);
    EXPECT_TRUE(check.closed_manifold());
    EXPECT_EQ(check.self_intersections, 0u);
    EXPECT_EQ(check.unused_vertices, 0u);
    return out;
}
inline Cast cast(const Body& body, int n, const ReconstructOptions& options = {},
                 const NormalEdit& edit = {}) {
    return cast(cast_body(body, test_box, n, edit), options);
}

/// From all layers.
inline Cast cast_deep(const Body& body, int n, ReconstructOptions options = {}, const NormalEdit& edit = {}) {
    options.complete_layers = true;
    return cast(cast_layers(body, test_box, n, edit), options);
}

} // namespace glcast::test
