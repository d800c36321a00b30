// The default levels, each as large as it is made for, against views that were not captured.
#include <gtest/gtest.h>

#include <filesystem>

#include "capture/capture_file.h"
#include "capture/reference_views.h"
#include "fixtures/shapes.h"
#include "tests/capture/scenes.h"
#include "tests/pictures/own_size.h"
#include "tests/support/osmesa_context.h"
#include "tools/mesh/check.h"
#include "tools/pipeline/pipeline.h"

namespace glcast::pictures {
namespace {

constexpr int n = 176, reference_n = 2 * n; // the coarsest level is 11 pixels wide: a window of SSIM

void write(const std::filesystem::path& path, const test::Cast& cast, const EngineOptions& options) {
    CaptureInfo info;
    info.n = options.n;
    info.box = cast.report.box;
    info.program = "fixture";
    info.frame = 1;
    info.normals = "signed";
    info.glcast_version = GLCAST_VERSION;
    CaptureWriter writer(path, info, int(cast.images.size()));
    for (const ViewImage& image : cast.images) ASSERT_TRUE(writer.add(image)) << writer.error();
    ASSERT_TRUE(writer.finish(cast.report.layers, cast.report.layer_method)) << writer.error();
}

/// A fixture's capture with all its layers, and 36 views that are not in it.
class Drawn {
  public:
    explicit Drawn(const std::string& shape)
        : scene(context.gl(), shape, fixtures::Way::immediate),
          path(std::filesystem::path(testing::TempDir()) / ("glcast-own-size-" + shape + ".exr")) {
        EngineOptions options;
        options.n = n;
        write(path, cast_of(options), options);
        options = test::small_options(reference_n);
        for (const glm::dmat4& rotation : reference_rotations(max_reference_views)) {
            options.eye_to_capture = rotation;
            const test::Cast cast = cast_of(options);
            for (const ViewImage& image : cast.images)
                views.push_back(reference_view(image, cast.report.box, rotation, ""));
        }
    }
    ~Drawn() { std::filesystem::remove(path); }

    MeshedCapture made(const PipelineOptions& options) const { return mesh_capture(path, options); }

  private:
    test::Cast cast_of(const EngineOptions& options) {
        test::Cast cast = test::capture(
            context.gl(), [&](const GlTable& gl) { scene.draw_shape(gl); }, options);
        EXPECT_TRUE(cast.report.ok) << cast.report.error;
        return cast;
    }

    test::OsmesaContext context;
    fixtures::Scene scene;
    std::filesystem::path path;

  public:
    std::vector<ReferenceView> views;
};

class DefaultLevels : public testing::TestWithParam<std::string> {};

TEST_P(DefaultLevels, LookRightAtTheirOwnSizes) {
    const Drawn drawn(GetParam());
    PipelineOptions whole;
    whole.full = true;
    const Level full = std::move(drawn.made(whole).levels.at(0));
    PipelineOptions by_default;
    by_default.check = CheckDepth::everything;
    const MeshedCapture made = drawn.made(by_default);
    const std::vector<OwnSize> sizes = own_sizes(made.levels, full, drawn.views);
    ASSERT_FALSE(sizes.empty());
    EXPECT_EQ(sizes[0].pixels, n / 2);
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        SCOPED_TRACE(std::to_string(sizes[k].pixels) + " pixels, " +
                     std::to_string(made.checks[k].triangles) + " triangles");
        EXPECT_TRUE(looks_right(sizes[k], k == 0))
            << sizes[k].level.psnr << " dB, the full surface " << sizes[k].full.psnr;
        EXPECT_TRUE(made.checks[k].closed_manifold()) << describe(made.checks[k]);
        EXPECT_EQ(made.checks[k].self_intersections, 0U);
        EXPECT_LE(made.levels[k].error.p999, made.sample * n / sizes[k].pixels / 8);
    }
    // The gate is one: the coarsest, drawn as large as the finest, does not pass.
    Level coarse = made.levels.back();
    coarse.pixels = n / 2.0;
    EXPECT_FALSE(looks_right(own_sizes({&coarse, 1}, full, drawn.views)[0], false));
    coarse.pixels = n / 3.1;
    EXPECT_THROW(own_sizes({&coarse, 1}, full, drawn.views), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Shapes, DefaultLevels, testing::Values("spheres", "teapot"),
                         [](const auto& info) { return info.param; });

TEST(LooksRight, FortyDecibelsOrHardlyWorseThanTheFullSurface) {
    const auto size = [](double level, double full) {
        OwnSize own;
        own.level.psnr = level, own.full.psnr = full;
        return own;
    };
    EXPECT_TRUE(looks_right(size(40, 50), false));
    EXPECT_FALSE(looks_right(size(40, 50), true)) << "the finest is as good as the full surface";
    EXPECT_FALSE(looks_right(size(39.9, 50), false));
    EXPECT_TRUE(looks_right(size(35.1, 36), false));
    EXPECT_TRUE(looks_right(size(35.1, 36), true));
    EXPECT_FALSE(looks_right(size(34.9, 36), false));
}

} // namespace
} // namespace glcast::pictures
