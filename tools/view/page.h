// One self-contained .html: levels of detail to turn and compare, beside the captured views (docs/guide/viewing.md).
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/capture_file.h"
#include "capture/view_image.h"
#include "tools/mesh/level.h"

namespace glcast {

/// A level and what is known of it. Lengths in model units.
struct PageLevel {
    const Mesh* mesh = nullptr;       ///< outlives make_page()
    const Texture* texture = nullptr; ///< likewise; null or empty: there is none
    const Wedges* wedges = nullptr;   ///< likewise
    std::string name;
    std::uint64_t glb_bytes = 0;           ///< of the level as a .glb of its own
    LevelError error;
    std::vector<double> vertex_distance;   ///< of each vertex to the surface of level 0
};

struct PageInput {
    std::string title;
    std::vector<PageLevel> levels; ///< finest first; at least one
    double sample = 0;             ///< lattice spacing, model units; 0 when unknown
    const CaptureInfo* capture = nullptr; ///< null: no views
    std::span<const ViewImage> views;     ///< layer 0 of the six views
};

struct PageOptions {
    std::size_t most_triangles = 1'000'000; ///< a level with more is listed, but not in the page
    int view_pixels = 512;                  ///< larger views are scaled down to this
};

struct Page {
    std::string html;
    std::vector<std::size_t> level_bytes; ///< of each level in the page, less its pictures; 0 where it was left out
    std::size_t picture_bytes = 0;        ///< of all textures in the page
};

/// Empty when this program can make pages, else one line: what was missing when it was built, and what to do.
std::string why_no_pages();

/// Throws std::runtime_error, one line, when why_no_pages() says so or no level is small enough.
Page make_page(const PageInput& input, const PageOptions& options = {});

} // namespace glcast
