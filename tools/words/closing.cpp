#include "tools/words/closing.h"

#include <cstdio>
#include <filesystem>

#include "tools/words/text.h"

namespace glcast {
namespace {

constexpr double invisible_pixels = 0.125; ///< at half of n pixels: a quarter of a sample
constexpr int narrowest = 8;

std::string two_digits(double value) {
    char text[40];
    std::snprintf(text, sizeof text, value < 0.095 ? "%.1g" : value < 99.5 ? "%.2g" : "%.0f", value);
    return text;
}

} // namespace

int invisible_width(double samples, int n) {
    for (int width = n / 2; width >= narrowest; width /= 2)
        if (samples * width <= invisible_pixels * n) return width;
    return 0;
}

std::string error_in_words(double samples, int n) {
    const std::string distance =
        two_digits(samples) + (samples == 1 ? " sample" : " samples") + " from what was drawn (";
    const int width = invisible_width(samples, n);
    return distance +
           (width > 0 ? "invisible at " + std::to_string(width) + " pixels)" : "visible at any size)");
}

std::string how_to_look(const std::string& file) {
    const std::filesystem::path page = std::filesystem::path(file).replace_extension(".html");
    return "glcast view " + shell_word(file) + " -o " + shell_word(page.string());
}

std::string closing_line(const Closing& c) {
    std::string line = c.what + ": " + counted(c.triangles, "triangle") + ", " +
                       error_in_words(c.error_samples, c.n) + ", in " + c.file;
    if (c.more_files > 0) line += ", with " + counted(c.more_files, "coarser level") + " beside it";
    return printable(line + "; to look at it: " + how_to_look(c.file));
}

} // namespace glcast
