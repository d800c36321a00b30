// PSNR and SSIM against closed forms, ImageMagick and scikit-image.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/file/file_tools.h"
#include "tests/pictures/quality.h"
#include "tools/render/render.h"

namespace glcast::pictures {
namespace {

constexpr int width = 64, height = 48;

std::uint8_t clamped(int value) { return std::uint8_t(std::clamp(value, 0, 255)); }

/// Lively enough that every window differs.
Picture pattern() {
    Picture p{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            p.rgb.push_back(std::uint8_t((7 * x + 13 * y + (x * y) % 31) % 256));
            p.rgb.push_back(std::uint8_t((5 * x + 3 * y + (x * x) % 17) % 256));
            p.rgb.push_back(std::uint8_t((11 * x + 2 * y) % 256));
        }
    return p;
}

Picture noisy() {
    Picture p = pattern();
    for (int i = 0; i < width * height; ++i) {
        const int x = i % width, y = i / width, noise = (x * 29 + y * 17) % 41 - 20;
        for (int k = 0; k < 3; ++k) p.rgb[i * 3 + k] = clamped(p.rgb[i * 3 + k] + (k == 1 ? -noise : noise));
    }
    return p;
}

Picture grey(std::uint8_t value) {
    return {width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 3, value)};
}

TEST(Quality, TheSamePictureHasNoError) {
    EXPECT_EQ(squared_error(pattern(), pattern()).mean(), 0);
    EXPECT_TRUE(std::isinf(psnr(0)));
    EXPECT_NEAR(ssim(pattern(), pattern()), 1, 1e-12);
}

TEST(Quality, GreysInClosedForm) {
    EXPECT_NEAR(psnr(squared_error(grey(100), grey(151)).mean()), 20 * std::log10(255.0 / 51), 1e-9);
    const double c1 = 2.55 * 2.55, a = 100, b = 151; // no variance: the first factor alone is left
    EXPECT_NEAR(ssim(grey(100), grey(151)), (2 * a * b + c1) / (a * a + b * b + c1), 1e-9);
}

TEST(Quality, PsnrIsImageMagicks) {
    const samples::Folder folder;
    write_png(folder / "a.png", pattern());
    write_png(folder / "b.png", noisy());
    const samples::Ran ran = samples::run("compare -metric PSNR " + (folder / "a.png").string() + " " +
                                          (folder / "b.png").string() + " null: 2>&1");
    ASSERT_FALSE(ran.output.empty());
    EXPECT_NEAR(psnr(squared_error(pattern(), noisy()).mean()), std::stod(ran.output), 0.001) << ran.output;
}

/// By scikit-image 0.19.3 (Debian 12): structural_similarity of the luminances with gaussian_weights=True,
/// sigma=1.5, use_sample_covariance=False, data_range=255; and peak_signal_noise_ratio.
TEST(Quality, ValuesAreScikitImages) {
    EXPECT_NEAR(ssim(pattern(), noisy()), 0.9919212977967282, 1e-6);
    EXPECT_NEAR(psnr(squared_error(pattern(), noisy()).mean()), 26.842673417147573, 1e-9);
}

TEST(Quality, SamplesOfAPixel) {
    Picture in{4, 2, {}};
    for (const int v : {0, 1, 10, 20, 2, 3, 30, 255})
        in.rgb.insert(in.rgb.end(), {std::uint8_t(v), 7, std::uint8_t(255 - v)});
    const Picture mean = antialiased(in, 2), one = one_sample(in, 2);
    EXPECT_EQ(mean.width, 2);
    EXPECT_EQ(mean.height, 1);
    EXPECT_EQ(mean.rgb, (std::vector<std::uint8_t>{2, 7, 254, 79, 7, 176})); // 1.5, 253.5, 78.75, 176.25
    EXPECT_EQ(one.rgb, (std::vector<std::uint8_t>{3, 7, 252, 255, 7, 0}));
    EXPECT_EQ(antialiased(in, 1).rgb, in.rgb);
    EXPECT_THROW(antialiased(in, 4), std::invalid_argument);
    EXPECT_THROW(one_sample(in, 0), std::invalid_argument);
}

TEST(Quality, OtherSizesAreRefused) {
    Picture small{16, 16, std::vector<std::uint8_t>(16 * 16 * 3)};
    EXPECT_THROW(squared_error(pattern(), small), std::invalid_argument);
    EXPECT_THROW(ssim(pattern(), small), std::invalid_argument);
    EXPECT_THROW(
        ssim(Picture{4, 4, std::vector<std::uint8_t>(48)}, Picture{4, 4, std::vector<std::uint8_t>(48)}),
        std::invalid_argument);
}

} // namespace
} // namespace glcast::pictures
