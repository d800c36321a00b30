// What goes in: any size, any order, nothing, nonsense; and the same bytes out for any number of threads.
#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <tbb/global_control.h>

#include "tests/reconstruct/cast.h"

namespace glcast::test {
namespace {

std::string refusal(const std::vector<ViewImage>& images, const ReconstructOptions& options = {}) {
    try {
        reconstruct(images, test_box, options);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

template <class T> bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Input, EachViewIsNeeded) {
    const auto images = cast_body(*sphere({0, 0, 0}, 0.8), test_box, 16);
    const char* names[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
    for (std::size_t i = 0; i < images.size(); ++i) {
        auto fewer = images;
        fewer.erase(fewer.begin() + long(i));
        EXPECT_NE(refusal(fewer).find(names[i]), std::string::npos) << refusal(fewer);
    }
    EXPECT_NE(refusal({}), "");
}

TEST(Input, OrderAndFurtherLayersDoNotMatter) {
    auto images = cast_body(*sphere({0, 0, 0}, 0.8), test_box, 24);
    const Cast made = cast(images);
    ViewImage extra = images[2];
    extra.view.layer = 1;
    std::reverse(images.begin(), images.end());
    images.push_back(extra);
    EXPECT_TRUE(same_bytes(cast(images).mesh.positions, made.mesh.positions));
}

TEST(Input, WrongSizesAndValuesAreRefused) {
    const auto images = cast_body(*sphere({0, 0, 0}, 0.8), test_box, 16);
    auto mixed = images;
    mixed[3] = cast_body(*sphere({0, 0, 0}, 0.8), test_box, 17)[3];
    EXPECT_NE(refusal(mixed), "");
    mixed = images;
    mixed[1].depth.pop_back();
    EXPECT_NE(refusal(mixed), "");
    ReconstructOptions options;
    options.close_gaps = -1;
    EXPECT_NE(refusal(images, options), "");
    options.close_gaps = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(images, options), "");
}

TEST(Input, NothingDrawnIsRefused) {
    EXPECT_NE(refusal(cast_body(*sphere({9, 9, 9}, 0.1), test_box, 16)), "");
}

TEST(Input, TheSmallestResolution) {
    const Cast made = cast(*sphere({0, 0, 0}, 0.7), 8);
    EXPECT_EQ(topology(made.mesh).euler, 2);
    EXPECT_LT(mesh_to_body(made.mesh, *sphere({0, 0, 0}, 0.7), sample_size(8)).mean, 0.1);
}

TEST(Input, ABodyThatFillsTheBoxIsClosedAtItsSides) {
    const Cast made = cast(*box({0, 0, 0}, {3, 3, 3}), 16);
    EXPECT_EQ(topology(made.mesh).euler, 2);
    EXPECT_EQ(made.report.filled_samples, 16u * 16 * 16);
}

TEST(Input, DepthsThatAreNoNumbersCountAsNothing) {
    auto images = cast_body(*sphere({0, 0, 0}, 0.8), test_box, 24);
    for (ViewImage& image : images)
        for (std::size_t p = 0; p < image.depth.size(); p += 7)
            image.depth[p] = std::numeric_limits<float>::quiet_NaN();
    cast(images);
}

TEST(Input, TheSameBytesForAnyNumberOfThreads) {
    const auto body = unite({torus({0, 0, 0}, {1, 2, 3}, 0.6, 0.2), sphere({0.2, 0.1, 0}, 0.5, {1, 1, 0}),
                             box({0, 0, 0}, {0.9, 0.2, 1e-9}, turned({1, 0, 0}, 30))});
    const auto images = cast_body(*body, test_box, 64);
    for (SurfaceMethod method : {SurfaceMethod::contour, SurfaceMethod::cubes}) {
        std::vector<Mesh> made;
        for (int threads : {1, 2, 5}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            made.push_back(cast(images, {method}).mesh);
        }
        for (const Mesh& mesh : made) {
            EXPECT_TRUE(same_bytes(mesh.positions, made[0].positions));
            EXPECT_TRUE(same_bytes(mesh.normals, made[0].normals));
            EXPECT_TRUE(same_bytes(mesh.colours, made[0].colours));
            EXPECT_TRUE(same_bytes(mesh.triangles, made[0].triangles));
        }
    }
}

TEST(Input, AHighResolution) {
    const auto body = sphere({0, 0, 0}, 0.9);
    const auto images = cast_body(*body, test_box, 512);
    const Mesh mesh = reconstruct(images, test_box, {});
    EXPECT_TRUE(check_mesh(mesh).closed_manifold());
    EXPECT_EQ(check_mesh(mesh).euler, 2);
    EXPECT_LT(mesh_to_body(mesh, *body, sample_size(512)).max, 0.01);
}

} // namespace
} // namespace glcast::test
