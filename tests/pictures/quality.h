// How alike two pictures are.
// SSIM: Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from error visibility to structural
// similarity".
#pragma once
#include "tools/mesh/picture.h"

namespace glcast::pictures {

/// Sum over red, green and blue of all pixels; 255 = 1. Throws std::invalid_argument where the sizes differ.
struct SquaredError {
    double sum = 0;
    std::size_t values = 0;

    double mean() const { return values ? sum / double(values) : 0; }
    SquaredError& operator+=(const SquaredError& other) {
        sum += other.sum, values += other.values;
        return *this;
    }
};
SquaredError squared_error(const Picture& a, const Picture& b);

/// Decibels of a mean squared error where 1 is the largest difference; infinite for 0.
double psnr(double mean_squared_error);

/// Mean over all windows of 11 x 11 pixels that lie in the picture (Gaussian weights, sigma 1.5, K1 .01, K2
/// .03), of luminance (.299 R + .587 G + .114 B). 1: the same. Pictures are at least 11 pixels wide and high.
double ssim(const Picture& a, const Picture& b);

/// A picture that was drawn with `samples` x `samples` samples a pixel: the mean of each block, of display
/// values, or one of its samples (below and right of the middle). Throws std::invalid_argument where it does
/// not divide.
Picture antialiased(const Picture& picture, int samples);
Picture one_sample(const Picture& picture, int samples);

} // namespace glcast::pictures
