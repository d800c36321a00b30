#include "shim/preload/contact_sheet.h"

#include <algorithm>
#include <cstring>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace glcast::preload {
namespace {

constexpr int margin = 8, line_height = 14, columns = 4;

struct Page {
    int width, height;
    std::vector<std::uint8_t> rgb;

    Page(int w, int h) : width(w), height(h), rgb(std::size_t(w) * h * 3, 255) {}
    void put(int x, int y, const std::uint8_t* colour) {
        if (x >= 0 && x < width && y >= 0 && y < height)
            std::memcpy(&rgb[(std::size_t(y) * width + x) * 3], colour, 3);
    }
};

/// stb_easy_font gives the strokes of letters as rectangles.
void write_text(Page& page, int x, int y, std::string text, const std::uint8_t* colour) {
    struct Corner {
        float x, y, z;
        std::uint8_t colour[4];
    };
    std::vector<Corner> corners(4 * 70 * (text.size() + 1));
    const int quads = stb_easy_font_print(float(x), float(y), text.data(), nullptr, corners.data(),
                                          int(corners.size() * sizeof(Corner)));
    for (int quad = 0; quad < quads; ++quad) {
        const Corner &lo = corners[std::size_t(quad) * 4], &hi = corners[std::size_t(quad) * 4 + 2];
        for (int v = int(lo.y); v < int(hi.y); ++v)
            for (int u = int(lo.x); u < int(hi.x); ++u) page.put(u, v, colour);
    }
}

void put_picture(Page& page, int left, int top, const Thumbnail& picture) {
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            page.put(left + x, top + picture.height - 1 - y,
                     &picture.rgb[(std::size_t(y) * picture.width + x) * 3]);
}

std::string title(const Candidate& c) {
    constexpr const char* kinds[] = {"perspective", "orthographic", "flat"};
    return std::to_string(c.number) + "  " + kinds[static_cast<int>(c.group.kind)] +
           (c.backdrop       ? ", backdrop"
            : c.inset        ? ", inset"
            : c.group.erased ? ", painted over"
                             : "");
}

std::string contents(const Group& group) {
    std::string text = std::to_string(group.triangles + group.outlined) + " triangles";
    if (group.lines) text += ", " + std::to_string(group.lines) + " lines";
    if (group.points) text += ", " + std::to_string(group.points) + " points";
    return text;
}

} // namespace

std::string write_contact_sheet(const std::vector<Candidate>& candidates, const std::string& path) {
    int cell_width = 200, cell_height = 20;
    for (const Candidate& c : candidates) {
        cell_width = std::max(cell_width, c.picture.width);
        cell_height = std::max(cell_height, c.picture.height);
    }
    const int count = int(candidates.size()), across = std::clamp(count, 1, columns);
    const bool windows =
        std::any_of(candidates.begin(), candidates.end(), [](auto& c) { return !c.window.empty(); });
    const int down = (count + across - 1) / across, text_height = line_height * (windows ? 3 : 2);
    Page page(across * (cell_width + margin) + margin, down * (cell_height + text_height + margin) + margin);
    constexpr std::uint8_t black[] = {0, 0, 0}, grey[] = {120, 120, 120};
    for (int i = 0; i < count; ++i) {
        const Candidate& c = candidates[std::size_t(i)];
        const int left = margin + i % across * (cell_width + margin);
        const int top = margin + i / across * (cell_height + text_height + margin);
        const auto* ink = is_scene(c) ? black : grey;
        write_text(page, left, top, title(c), ink);
        write_text(page, left, top + line_height, contents(c.group), ink);
        write_text(page, left, top + 2 * line_height, c.window, ink);
        put_picture(page, left, top + text_height, c.picture);
    }
    if (stbi_write_png(path.c_str(), page.width, page.height, 3, page.rgb.data(), page.width * 3)) return {};
    return "cannot write " + path;
}

} // namespace glcast::preload
