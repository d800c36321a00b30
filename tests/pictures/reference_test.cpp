// Levels against views that were not captured: a mesh that is what was drawn looks like it, one that is not
// does not.
#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "capture/reference_views.h"
#include "fixtures/shapes.h"
#include "tests/capture/scenes.h"
#include "tests/mesh/bodies.h"
#include "tests/pictures/reference.h"
#include "tests/support/osmesa_context.h"
#include "tools/render/render.h"

namespace glcast::pictures {
namespace {

constexpr int n = 96;

/// 36 views of a fixture, by the engine.
std::vector<ReferenceView> views_of(const std::string& shape) {
    test::OsmesaContext context;
    fixtures::Scene scene(context.gl(), shape, fixtures::Way::immediate);
    const DrawFunction draw = [&](const GlTable& gl) { scene.draw_shape(gl); };
    EngineOptions options = test::small_options(n);
    std::vector<ReferenceView> views;
    for (const glm::dmat4& rotation : reference_rotations(max_reference_views)) {
        options.eye_to_capture = rotation;
        const test::Cast cast = test::capture(context.gl(), draw, options);
        EXPECT_TRUE(cast.report.ok) << cast.report.error;
        for (const ViewImage& image : cast.images)
            views.push_back(reference_view(image, cast.report.box, rotation, ""));
    }
    return views;
}

Mesh moved(Mesh mesh, const glm::dvec3& by) {
    for (glm::dvec3& p : mesh.positions) p += by;
    return mesh;
}

TEST(PictureError, WhatWasDrawnLooksLikeItself) {
    for (const std::string shape : {"spheres", "teapot", "cube"}) {
        SCOPED_TRACE(shape);
        const std::vector<ReferenceView> views = views_of(shape);
        ASSERT_EQ(views.size(), 36u);
        const Mesh mesh = fixtures::truth(shape);
        const PictureError same = picture_error(Level{mesh, ""}, views);
        EXPECT_GT(same.one_sample.psnr, 44) << "only pixels on silhouettes may differ";
        EXPECT_GT(same.one_sample.ssim, 0.998);
        EXPECT_LT(same.psnr_covered, same.one_sample.psnr);
        EXPECT_LE(same.one_sample.psnr_worst, same.one_sample.psnr);
        EXPECT_GT(same.psnr_inside, 44);
        EXPECT_GT(same.background_share, 0.2);
        const double sample = views[0].camera.pixel;
        const PictureError shifted = picture_error(Level{moved(mesh, glm::dvec3(sample)), ""}, views);
        EXPECT_LT(shifted.one_sample.psnr, same.one_sample.psnr - 10) << "a sample aside along each axis";
    }
}

TEST(PictureError, ColoursAndNormalsCount) {
    const std::vector<ReferenceView> views = views_of("torus");
    Mesh mesh = fixtures::truth("torus");
    const PictureError same = picture_error(Level{mesh, ""}, views);
    Mesh dark = mesh;
    for (glm::vec3& colour : dark.colours) colour *= 0.8f;
    EXPECT_LT(picture_error(Level{dark, ""}, views).one_sample.psnr, same.one_sample.psnr - 6);
    for (glm::vec3& normal : mesh.normals) normal = -normal;
    EXPECT_LT(picture_error(Level{mesh, ""}, views).one_sample.psnr, same.one_sample.psnr - 6);
}

/// Every pixel of the error in closed form: a picture that is all background against one square of n x n.
TEST(PictureError, AMissingSquareInClosedForm) {
    ViewImage image = blank_image({Axis::z, Side::plus, 0}, n);
    const int side = 30;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) image.colour[std::size_t(40 + j) * n + 20 + i] = glm::vec4(0, 0, 0, 1);
    const ReferenceView view = reference_view(image, {glm::dvec3(-1), 2}, glm::dmat4(1.0), "");
    Mesh aside; // out of the picture
    aside.positions = {{10, 10, 0}, {11, 10, 0}, {10, 11, 0}};
    aside.triangles = {{0, 1, 2}};
    const PictureError error = picture_error(Level{aside, ""}, {&view, 1});
    const double value = 242.0 / 255, share = double(side * side) / (n * n);
    EXPECT_NEAR(error.one_sample.psnr, -10 * std::log10(value * value * share), 1e-9);
    EXPECT_NEAR(error.psnr_covered, -10 * std::log10(value * value), 1e-9);
    EXPECT_NEAR(error.background_share, 1 - share, 1e-12);
    EXPECT_TRUE(std::isinf(error.psnr_inside)) << "no pixel is covered by both";
    EXPECT_NEAR(error.psnr_outline, error.antialiased.psnr, 1e-9);
    EXPECT_TRUE(std::isinf(error.psnr_filling));
    EXPECT_LT(error.one_sample.ssim, 1);
}

/// A square that is a sample aside: whole pixels of one sample flip, or none; with four samples a pixel,
/// pixels on two of its edges are half off.
TEST(PictureError, ASquareAsideInClosedForm) {
    ViewImage image = blank_image({Axis::z, Side::plus, 0}, n);
    const int side = 30;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) image.colour[std::size_t(40 + j) * n + 20 + i] = glm::vec4(0, 0, 0, 1);
    const ReferenceView view = reference_view(image, {glm::dvec3(-1), 2}, glm::dmat4(1.0), "");
    Mesh square; // a sample to the right of it
    const auto corner = [](int i, int j) { return glm::dvec3(-1 + 2.0 * i / n, -1 + 2.0 * j / n, 0); };
    square.positions = {corner(21, 40), corner(51, 40), corner(51, 70), corner(21, 70)};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.colours.assign(4, glm::vec3(0));
    const PictureError error = picture_error(Level{square, ""}, {&view, 1}, 2);
    const double half = 121.0 / 255, pixels = n * n / 4.0;
    EXPECT_EQ(error.width, n / 2);
    EXPECT_NEAR(error.antialiased.psnr, -10 * std::log10(half * half * side / pixels), 1e-9);
    EXPECT_TRUE(std::isinf(error.one_sample.psnr)) << "samples of odd columns: 21 to 49 of both";
    EXPECT_NEAR(error.psnr_outline, error.antialiased.psnr, 1e-9);
    EXPECT_TRUE(std::isinf(error.psnr_filling));
    square.colours.assign(4, glm::vec3(1)); // 29 of 30 columns of it are white where both are
    const PictureError white = picture_error(Level{square, ""}, {&view, 1}, 1);
    EXPECT_NEAR(white.psnr_filling, -10 * std::log10(double(side) * (side - 1) / (n * n)), 1e-9);
    EXPECT_LT(white.psnr_filling, white.psnr_outline);
    EXPECT_THROW(picture_error(Level{square, ""}, {&view, 1}, 7), std::invalid_argument);
}

/// Two ways to draw the same mesh, one of them Mesa's.
TEST(Raster, SeesWhatOsmesaDraws) {
    Mesh mesh = fixtures::truth("teapot");
    mesh.colours.assign(mesh.positions.size(), glm::vec3(1));
    const int size = 200;
    const glm::dvec3 way = glm::normalize(glm::dvec3(-1, -2, -0.5));
    const Picture osmesa = picture(mesh, way, size);
    const Picture own = picture(Level{mesh, ""}, way, size);
    long off = 0;
    for (std::size_t i = 0; i < own.rgb.size(); ++i)
        off += std::abs(int(own.rgb[i]) - int(osmesa.rgb[i])) > 6;
    EXPECT_LT(double(off) / double(own.rgb.size()), 0.01); // light per pixel here, per vertex there
}

/// How far the second row of a sheet is from the first in each of the six sides, as a share of what is not paper.
std::vector<double> differences_of_rows(const Picture& sheet, int size) {
    const int pitch = size + 1, row = (sheet.height - 12) / 2; // as far below the first row of tiles stands the second
    std::vector<double> shares;
    for (int column = 0; column < 6; ++column) {
        double difference = 0, contrast = 0;
        for (int y = 25; y < 25 + size; ++y)
            for (int x = 1; x < size; ++x) {
                const auto at = [&](int px, int py) {
                    return int(sheet.rgb[(std::size_t(py) * sheet.width + px) * 3]);
                };
                const int here = column * pitch + x;
                difference += std::abs(at(here, y) - at(here, y + row));
                contrast += std::abs(at(here, y) - 242);
            }
        EXPECT_GT(contrast, 1000);
        shares.push_back(difference / contrast);
    }
    return shares;
}

/// Normals that point up.
void turn_over(Mesh& mesh, std::vector<ViewImage>& images) {
    const auto turn = [](auto& normal) { normal *= normal.y > 0 ? -1.0f : 1.0f; };
    for (glm::vec3& normal : mesh.normals) turn(normal);
    for (ViewImage& image : images)
        for (glm::vec4& normal : image.normal) {
            const float drawn = normal.w;
            turn(normal);
            normal.w = drawn;
        }
}

/// What was captured stands over what was drawn: same place, same scale, same light, and no tile turned or
/// mirrored; also where normals were drawn away from the viewer.
TEST(Sheet, CapturedViewsLieOverTheLevels) {
    for (const std::string shape : {"spheres", "teapot"}) { // closed, and open: backs are seen
        SCOPED_TRACE(shape);
        test::OsmesaContext context;
        fixtures::Scene scene(context.gl(), shape, fixtures::Way::immediate);
        test::Cast cast = test::capture(
            context.gl(), [&](const GlTable& gl) { scene.draw_shape(gl); }, test::small_options(128));
        ASSERT_TRUE(cast.report.ok);
        Level level{fixtures::truth(shape), "level 0", {}, 0, {}};
        for (const bool turned_over : {false, true}) {
            if (turned_over) turn_over(level.mesh, cast.images);
            const CapturedViews captured{"captured", cast.images, cast.report.box};
            constexpr int size = 100;
            for (const double share : differences_of_rows(contact_sheet({&level, 1}, size, &captured), size))
                EXPECT_LT(share, 0.1) << (turned_over ? "turned over" : "as they are");
        }
    }
}

/// A square whose texture has four colours and whose normal map leans each way.
TEST(Raster, TextureAndNormalMap) {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.colours.assign(4, glm::vec3(1, 0, 1));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    Texture texture;
    const glm::vec2 at[] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}}; // (0, 0) is the top left
    for (const Triangle& t : mesh.triangles) {
        texture.coordinates.push_back({at[t[0]], at[t[1]], at[t[2]]});
        texture.tangents.push_back({glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1)});
    }
    texture.colour = {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0}};
    texture.normal = {2, 2, {255, 128, 128, 0, 128, 128, 128, 255, 128, 128, 128, 255}};
    OrthoView view;
    view.width = view.height = 8;
    view.pixel = 0.25;
    const SeenImage seen = rasterise(mesh, texture, view);
    const auto pixel = [](int x, int y) { return std::size_t(y) * 8 + x; };
    EXPECT_EQ(std::count(seen.covered.begin(), seen.covered.end(), 1), 64);
    EXPECT_EQ(seen.colour[pixel(0, 0)], glm::vec3(1, 0, 0));
    EXPECT_EQ(seen.colour[pixel(7, 0)], glm::vec3(0, 1, 0));
    EXPECT_EQ(seen.colour[pixel(0, 7)], glm::vec3(0, 0, 1));
    EXPECT_EQ(seen.colour[pixel(7, 7)], glm::vec3(1, 1, 0));
    EXPECT_GT(seen.normal[pixel(0, 0)].x, 0.99f);
    EXPECT_LT(seen.normal[pixel(7, 0)].x, -0.99f);
    EXPECT_GT(seen.normal[pixel(0, 7)].y, 0.99f) << "+y of the map is up in the picture";
    EXPECT_GT(seen.normal[pixel(7, 7)].z, 0.99f);
    texture.coordinates.pop_back();
    EXPECT_THROW(rasterise(mesh, texture, view), std::runtime_error);
}

/// Neighbours share each pixel on their edge: no hole shows what lies behind.
TEST(Raster, NoCracksBetweenTriangles) {
    const Mesh ball = test::sphere(1, 4);
    OrthoView view;
    view.width = view.height = 333;
    view.pixel = 2.0 / 333;
    const SeenImage seen = rasterise(ball, {}, view);
    for (int y = 0; y < 333; ++y)
        for (int x = 0; x < 333; ++x) {
            const double dx = (x + 0.5) / 166.5 - 1, dy = (y + 0.5) / 166.5 - 1;
            const double distance = std::hypot(dx, dy);
            if (distance > 0.95 && distance < 1) continue;
            EXPECT_EQ(bool(seen.covered[std::size_t(y) * 333 + x]), distance < 1) << x << ' ' << y;
        }
}

} // namespace
} // namespace glcast::pictures
