#include "tests/pictures/reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "capture/reference_views.h"
#include "tests/pictures/quality.h"
#include "tools/io/capture_reader.h"

namespace glcast::pictures {
namespace {

constexpr std::uint8_t background = 242;

/// A direction or point of the image's frame, in the capture frame.
glm::dvec3 back_to(const glm::dmat4& from_capture, const glm::dvec3& v) {
    return glm::transpose(glm::dmat3(from_capture)) * v;
}

OrthoView camera_of(const View& view, int n, const Box& box, const glm::dmat4& from_capture) {
    const ImageAxes axes = image_axes(view.axis);
    glm::dvec3 up(0), back(0);
    up[axes.v] = 1;
    back[axes.depth] = view.side == Side::plus ? 1 : -1;
    OrthoView camera;
    camera.up = back_to(from_capture, up);
    camera.back = back_to(from_capture, back);
    camera.right = glm::cross(camera.up, camera.back);
    camera.centre = back_to(from_capture, box.lo + 0.5 * box.size);
    camera.pixel = box.size / n;
    camera.width = camera.height = n;
    return camera;
}

/// Images of both sides share their columns; seen from one of them they are mirrored.
bool is_mirrored(const View& view) {
    const bool left_handed = view.axis == Axis::y; // x, z, y
    return left_handed == (view.side == Side::plus);
}

float light_on(const glm::vec3& normal, const OrthoView& camera) {
    static const glm::dvec3 upper_left = glm::normalize(glm::dvec3(-1, 1, 1));
    const glm::dvec3 n(normal);
    const glm::dvec3 eye(dot(n, camera.right), dot(n, camera.up), dot(n, camera.back));
    return float(.3 + .45 * std::max(0.0, eye.z) + .25 * std::max(0.0, dot(eye, upper_left)));
}

Picture light_up(const SeenImage& seen, const OrthoView& camera, const std::vector<char>* dark) {
    Picture picture{seen.width, seen.height, std::vector<std::uint8_t>(seen.covered.size() * 3, background)};
    for (std::size_t p = 0; p < seen.covered.size(); ++p) {
        if (!seen.covered[p]) continue;
        const float light = dark && (*dark)[p] ? 1 : light_on(seen.normal[p], camera);
        for (int k = 0; k < 3; ++k)
            picture.rgb[p * 3 + std::size_t(k)] =
                std::uint8_t(std::lround(std::clamp(seen.colour[p][k] * light, 0.0f, 1.0f) * 255));
    }
    return picture;
}

/// Of the pixels that both cover: what lies within both outlines.
SquaredError error_inside(const Picture& a, const Picture& b, const std::vector<char>& first,
                          const std::vector<char>& second) {
    SquaredError error;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        if (!first[i / 3] || !second[i / 3]) continue;
        const double d = (double(a.rgb[i]) - double(b.rgb[i])) / 255;
        error.sum += d * d, ++error.values;
    }
    return error;
}

/// `b` where both cover a sample, else `a`; or, not `within`, the other way round.
Picture mixed(const Picture& a, const Picture& b, const std::vector<char>& first,
              const std::vector<char>& second, bool within) {
    Picture out = a;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        if ((first[i / 3] && second[i / 3]) == within) out.rgb[i] = b.rgb[i];
    return out;
}

/// Covered by the reference, but drawn without light.
std::vector<char> without_light(const ReferenceView& view) {
    std::vector<char> dark(view.lit.size());
    for (std::size_t p = 0; p < dark.size(); ++p) dark[p] = view.seen.covered[p] && !view.lit[p];
    return dark;
}

/// Of one view, or summed up over some.
struct PictureSum {
    SquaredError squares;
    double worst = 0, ssim = 0;

    void operator+=(const PictureSum& view) {
        squares += view.squares;
        worst = std::max(worst, view.squares.mean());
        ssim += view.ssim;
    }
    Likeness over(std::size_t views) const {
        return {psnr(squares.mean()), psnr(worst), ssim / double(views)};
    }
};
struct ViewError {
    PictureSum antialiased, one_sample;
    SquaredError all, inside, outline, filling;
    std::size_t covered = 0; ///< samples

    void operator+=(const ViewError& view) {
        antialiased += view.antialiased, one_sample += view.one_sample;
        all += view.all, inside += view.inside;
        outline += view.outline, filling += view.filling;
        covered += view.covered;
    }
};

PictureSum compare(const Picture& a, const Picture& b) { return {squared_error(a, b), 0, ssim(a, b)}; }

ViewError compare(const SeenImage& level, const ReferenceView& view, int samples) {
    const Picture a = lit(view), b = lit(level, view);
    const auto part = [&](bool within) {
        return squared_error(antialiased(a, samples),
                             antialiased(mixed(a, b, view.seen.covered, level.covered, within), samples));
    };
    ViewError error{compare(antialiased(a, samples), antialiased(b, samples)),
                    compare(one_sample(a, samples), one_sample(b, samples)),
                    squared_error(a, b),
                    error_inside(a, b, view.seen.covered, level.covered),
                    part(false),
                    part(true),
                    0};
    for (std::size_t p = 0; p < level.covered.size(); ++p)
        error.covered += level.covered[p] || view.seen.covered[p];
    return error;
}

/// Of all views.
PictureError summed(const std::vector<ViewError>& errors, std::span<const ReferenceView> views, int samples) {
    ViewError sum;
    for (const ViewError& error : errors) sum += error;
    PictureError result;
    result.antialiased = sum.antialiased.over(views.size());
    result.one_sample = sum.one_sample.over(views.size());
    result.psnr_covered = psnr(sum.covered ? sum.all.sum / (3.0 * double(sum.covered)) : 0);
    result.psnr_inside = psnr(sum.inside.mean());
    result.psnr_outline = psnr(sum.outline.mean());
    result.psnr_filling = psnr(sum.filling.mean());
    result.background_share = 1 - double(sum.covered) / (double(sum.all.values) / 3);
    result.width = views.empty() ? 0 : views[0].camera.width / samples;
    result.views = views.size();
    return result;
}

} // namespace

ReferenceView reference_view(const ViewImage& image, const Box& box, const glm::dmat4& from_capture,
                             std::string name) {
    const int n = image.n;
    const std::size_t count = image.depth.size();
    ReferenceView view{
        std::move(name),
        camera_of(image.view, n, box, from_capture),
        {n, n, std::vector<char>(count), std::vector<glm::vec3>(count), std::vector<glm::vec3>(count)},
        std::vector<char>(count)};
    const bool mirrored = is_mirrored(image.view);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const std::size_t to = std::size_t(y) * n + x,
                              from = std::size_t(n - 1 - y) * n + (mirrored ? n - 1 - x : x);
            if (!image.covered(from)) continue;
            const glm::dvec3 normal = back_to(from_capture, glm::dvec3(image.normal[from]));
            const double length = glm::length(normal);
            view.seen.covered[to] = 1;
            view.seen.colour[to] = glm::vec3(image.colour[from]);
            view.lit[to] = image.normal[from].w > 0 && length > 0;
            if (view.lit[to]) view.seen.normal[to] = glm::vec3(normal / length);
        }
    return view;
}

std::vector<ReferenceView> read_references(const std::filesystem::path& capture) {
    const CaptureInfo info = read_capture_info(capture);
    std::vector<ReferenceView> views;
    for (int number = 1;; ++number) {
        const std::filesystem::path path = reference_name(capture.string(), number);
        if (!std::filesystem::exists(path)) break;
        const Capture turned = read_capture(path);
        if (!turned.info.from_capture) throw std::runtime_error(path.string() + " is no reference view");
        const glm::dmat4 wanted = *turned.info.from_capture * info.eye_to_capture;
        for (int k = 0; k < 16; ++k)
            if (std::abs(wanted[k / 4][k % 4] - turned.info.eye_to_capture[k / 4][k % 4]) >
                1e-9 * (1 + std::abs(wanted[k / 4][k % 4])))
                throw std::runtime_error(path.string() + " belongs to another frame than " +
                                         capture.string());
        for (const ViewImage& image : turned.images) {
            const std::string side = part_name(image.view).substr(0, 2);
            views.push_back(reference_view(image, turned.info.box, *turned.info.from_capture,
                                           std::to_string(number) + " " + side));
        }
    }
    if (views.empty())
        throw std::runtime_error("there are no reference views beside " + capture.string() +
                                 ": capture it with GLCAST_REFERENCE_VIEWS=36");
    return views;
}

Picture lit(const ReferenceView& view) {
    const std::vector<char> dark = without_light(view);
    return light_up(view.seen, view.camera, &dark);
}

Picture lit(const SeenImage& level, const ReferenceView& where) {
    const std::vector<char> dark = without_light(where);
    return light_up(level, where.camera, &dark);
}

std::vector<PictureError> picture_errors(const Level& level, std::span<const ReferenceView> views,
                                         std::span<const int> samples) {
    std::vector<std::vector<ViewError>> errors(samples.size(), std::vector<ViewError>(views.size()));
    tbb::parallel_for(std::size_t(0), views.size(), [&](std::size_t k) {
        const SeenImage seen = rasterise(level, views[k].camera);
        for (std::size_t i = 0; i < samples.size(); ++i) errors[i][k] = compare(seen, views[k], samples[i]);
    });
    std::vector<PictureError> results;
    for (std::size_t i = 0; i < samples.size(); ++i) results.push_back(summed(errors[i], views, samples[i]));
    return results;
}

PictureError picture_error(const Level& level, std::span<const ReferenceView> views, int samples) {
    return picture_errors(level, views, {&samples, 1}).front();
}

} // namespace glcast::pictures
