// Charts: connected triangles of one view that do not cover one another in its picture.
#pragma once
#include "tools/texture/views.h"

namespace glcast {

struct Charts {
    std::vector<std::uint32_t> of; ///< chart of each triangle
    struct Chart {
        ViewNumber view = 0;
        glm::dvec2 low{0}, high{0}; ///< bounds in its view's picture (in_picture), model units
    };
    std::vector<Chart> charts; ///< by their first triangle's part, view and order of growth
};

/// Connected parts of a view; one that covers itself (farther than the cells of a grid of `cell` model units
/// can tell) is grown anew from its first triangle, and what would cover something already there starts a
/// further chart.
Charts make_charts(const Mesh& mesh, const Neighbours& neighbours, const std::vector<ViewNumber>& views,
                   double cell, const glm::dvec3& origin);

} // namespace glcast
