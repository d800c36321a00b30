// texture-pictures CAPTURE.exr OUT-PREFIX [SIZE [TRIANGLES ...]]: the atlas of each level and pictures of it,
// and how far they are from pictures of the full surface. With - for
// OUT-PREFIX only what the baking costs.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "tests/texture/ray_picture.h"
#include "tools/io/capture_reader.h"
#include "tools/reconstruct/reconstruct.h"
#include "tools/render/render.h"
#include "tools/simplify/simplify.h"
#include "tools/texture/bake.h"

namespace {

using namespace glcast;
using namespace glcast::test;

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Evenly over the sphere (Fibonacci).
glm::dvec3 direction(int k, int count) {
    const double z = 1 - (2 * k + 1.0) / count, turn = k * 2.399963229728653;
    return {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
}

RayView whole(const Mesh& mesh) {
    glm::dvec3 low(mesh.positions.at(0)), high(low);
    for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    RayView view;
    view.centre = 0.5 * (low + high);
    view.radius = 0.55 * glm::length(high - low);
    view.size = 384;
    return view;
}

/// Side by side.
void append(Picture& row, const Picture& next) {
    Picture out{row.width + next.width, next.height, {}};
    for (int y = 0; y < next.height; ++y) {
        out.rgb.insert(out.rgb.end(), row.rgb.begin() + std::ptrdiff_t(y) * row.width * 3,
                       row.rgb.begin() + std::ptrdiff_t(y + 1) * row.width * 3);
        out.rgb.insert(out.rgb.end(), next.rgb.begin() + std::ptrdiff_t(y) * next.width * 3,
                       next.rgb.begin() + std::ptrdiff_t(y + 1) * next.width * 3);
    }
    row = std::move(out);
}

void show(const Mesh& surface, const RayPictures& full, const Level& level, const std::string& prefix) {
    write_png(prefix + "-colour.png", level.texture.colour);
    write_png(prefix + "-normal.png", level.texture.normal);
    const RayPictures own_pictures(level);
    RayView view = whole(surface);
    view.along = {-0.5, -0.45, -0.74};
    Picture row{0, view.size, {}};
    RayView by_vertices = view;
    by_vertices.vertices = true;
    append(row, full(by_vertices));
    append(row, own_pictures(view));
    append(row, own_pictures(by_vertices));
    write_png(prefix + "-view.png", row);
    constexpr int views = 8;
    const char* names[] = {"lit", "colour", "normal"};
    for (Show what : {Show::lit, Show::colour, Show::normal}) {
        double textured = 0, vertices = 0, own = 0;
        for (int k = 0; k < views; ++k) {
            RayView by_texture = view;
            by_texture.show = by_vertices.show = what;
            by_texture.along = by_vertices.along = direction(k, views);
            const Picture wanted = full(by_vertices);
            textured += std::pow(10, -psnr(own_pictures(by_texture), wanted) / 10) / views;
            vertices += std::pow(10, -psnr(own_pictures(by_vertices), wanted) / 10) / views;
            own += std::pow(10, -psnr(own_pictures(by_texture), full(by_texture)) / 10) / views;
        }
        std::printf(
            "    %-6s textured %.1f dB (against the full surface textured %.1f dB), vertices alone %.1f dB\n",
            names[int(what)], -10 * std::log10(textured), -10 * std::log10(own), -10 * std::log10(vertices));
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3)
        return std::fprintf(stderr, "texture-pictures CAPTURE.exr OUT-PREFIX [SIZE [TRIANGLES ...]]\n"), 2;
    TextureOptions options;
    if (argc > 3) options.size = std::atoi(argv[3]);
    HitBuilder hits;
    const CaptureInfo info = read_capture(argv[1], [&](ViewImage&& image) { hits.add(image); });
    ReconstructOptions how;
    how.complete_layers = info.layers == Layers::complete;
    CapturedSurface captured;
    Level full;
    full.mesh = reconstruct(std::move(hits), info.box, how, nullptr, &captured);
    std::vector<SimplifyTarget> targets;
    for (int k = 4; k < argc; ++k) targets.push_back({SimplifyTarget::Unit::triangles, std::atof(argv[k])});
    std::vector<Level> levels(1 + targets.size());
    levels[0].mesh = full.mesh;
    const auto simplified = simplify_levels(full.mesh, targets);
    for (std::size_t k = 0; k < simplified.size(); ++k) levels[k + 1].mesh = simplified[k];
    const auto drawn = full.mesh.normals; // a texture has its own
    std::unique_ptr<RayPictures> pictures;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        Level& level = levels[k];
        TextureReport report;
        const double start = seconds();
        const std::clock_t cpu = std::clock();
        level.texture = bake_texture(level.mesh, captured, options, &report);
        std::printf("%zu triangles: %zu charts, %.3f texels a sample, gutter %d, %zu texels, %zu unseen, "
                    "%.2f s, on all cores %.2f s\n",
                    level.mesh.triangles.size(), report.charts, report.texels_per_sample, report.gutter,
                    report.texels, report.texels_unseen, seconds() - start,
                    double(std::clock() - cpu) / CLOCKS_PER_SEC);
        std::fflush(stdout);
        if (std::string(argv[2]) == "-") continue;
        if (k == 0) {
            full = levels[0];
            full.mesh.normals = drawn;
            pictures = std::make_unique<RayPictures>(full);
        }
        show(full.mesh, *pictures, level, argv[2] + std::to_string(k));
    }
}
