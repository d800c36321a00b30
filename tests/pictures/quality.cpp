#include "tests/pictures/quality.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace glcast::pictures {
namespace {

constexpr int window = 11;
constexpr double sigma = 1.5, range = 255, c1 = (.01 * range) * (.01 * range),
                 c2 = (.03 * range) * (.03 * range);

void check_same_size(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size())
        throw std::invalid_argument("the pictures differ in size");
}

std::array<double, window> gaussian() {
    std::array<double, window> weights{};
    double sum = 0;
    for (int k = 0; k < window; ++k) {
        const double d = k - window / 2;
        sum += weights[k] = std::exp(-d * d / (2 * sigma * sigma));
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;
};

Plane luminance(const Picture& picture) {
    Plane plane{picture.width, picture.height, {}};
    plane.values.reserve(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        plane.values.push_back(.299 * picture.rgb[i] + .587 * picture.rgb[i + 1] + .114 * picture.rgb[i + 2]);
    return plane;
}

/// Weighted means of the windows that lie in the plane.
Plane filtered(const Plane& in) {
    static const std::array<double, window> weights = gaussian();
    Plane across{in.width - window + 1, in.height, {}};
    across.values.resize(std::size_t(across.width) * std::size_t(across.height));
    for (int y = 0; y < across.height; ++y)
        for (int x = 0; x < across.width; ++x) {
            double sum = 0;
            for (int k = 0; k < window; ++k) sum += weights[k] * in.values[std::size_t(y) * in.width + x + k];
            across.values[std::size_t(y) * across.width + x] = sum;
        }
    Plane out{across.width, in.height - window + 1, {}};
    out.values.resize(std::size_t(out.width) * std::size_t(out.height));
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            double sum = 0;
            for (int k = 0; k < window; ++k)
                sum += weights[k] * across.values[std::size_t(y + k) * across.width + x];
            out.values[std::size_t(y) * out.width + x] = sum;
        }
    return out;
}

/// `pixel(block's first sample, channel)` of each block.
template <class Pixel> Picture of_blocks(const Picture& in, int samples, const Pixel& pixel) {
    if (samples < 1 || in.width % samples || in.height % samples)
        throw std::invalid_argument("a picture of " + std::to_string(in.width) + " x " +
                                    std::to_string(in.height) + " has no blocks of " +
                                    std::to_string(samples));
    Picture out{in.width / samples, in.height / samples, {}};
    out.rgb.reserve(std::size_t(out.width) * std::size_t(out.height) * 3);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                out.rgb.push_back(
                    pixel((std::size_t(y) * in.width + std::size_t(x)) * std::size_t(samples), c));
    return out;
}

Plane product(const Plane& a, const Plane& b) {
    Plane out = a;
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= b.values[i];
    return out;
}

} // namespace

SquaredError squared_error(const Picture& a, const Picture& b) {
    check_same_size(a, b);
    SquaredError error;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double d = (double(a.rgb[i]) - double(b.rgb[i])) / 255;
        error.sum += d * d;
    }
    error.values = a.rgb.size();
    return error;
}

double psnr(double mean_squared_error) {
    return mean_squared_error > 0 ? -10 * std::log10(mean_squared_error)
                                  : std::numeric_limits<double>::infinity();
}

double ssim(const Picture& a, const Picture& b) {
    check_same_size(a, b);
    if (a.width < window || a.height < window)
        throw std::invalid_argument("the pictures are too small for SSIM");
    const Plane x = luminance(a), y = luminance(b);
    const Plane mean_x = filtered(x), mean_y = filtered(y), xx = filtered(product(x, x)),
                yy = filtered(product(y, y)), xy = filtered(product(x, y));
    double sum = 0;
    for (std::size_t i = 0; i < mean_x.values.size(); ++i) {
        const double mx = mean_x.values[i], my = mean_y.values[i], vx = xx.values[i] - mx * mx,
                     vy = yy.values[i] - my * my, covariance = xy.values[i] - mx * my;
        sum += (2 * mx * my + c1) * (2 * covariance + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
    }
    return sum / double(mean_x.values.size());
}

Picture antialiased(const Picture& picture, int samples) {
    const unsigned count = unsigned(samples * samples);
    return of_blocks(picture, samples, [&](std::size_t first, std::size_t c) {
        unsigned sum = 0;
        for (int j = 0; j < samples; ++j)
            for (int i = 0; i < samples; ++i)
                sum += picture.rgb[(first + std::size_t(j) * picture.width + i) * 3 + c];
        return std::uint8_t((sum + count / 2) / count);
    });
}

Picture one_sample(const Picture& picture, int samples) {
    const std::size_t inward = std::size_t(samples / 2);
    return of_blocks(picture, samples, [&](std::size_t first, std::size_t c) {
        return picture.rgb[(first + inward * std::size_t(picture.width) + inward) * 3 + c];
    });
}

} // namespace glcast::pictures
