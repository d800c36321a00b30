#include "tools/view/seams.h"

#include "tools/mesh/corner_split.h"

namespace glcast::view {

CutMesh cut_at_seams(const Mesh& mesh, std::span<const double> distance, const Texture& texture,
                     const Wedges& wedges) {
    CornerSplit split = split_corners(mesh, texture, wedges);
    CutMesh cut;
    for (std::size_t v = 0; v < split.vertices(mesh); ++v) {
        const std::uint32_t original = split.original(mesh, v);
        cut.mesh.positions.push_back(mesh.positions[original]);
        cut.distance.push_back(distance[original]);
        if (has_normals(mesh, wedges)) cut.mesh.normals.push_back(split.normal(mesh, v));
        if (has_colours(mesh, wedges)) cut.mesh.colours.push_back(split.colour(mesh, v));
    }
    cut.mesh.triangles = std::move(split.triangles);
    cut.coordinates = std::move(split.coordinates);
    cut.tangents = std::move(split.tangents);
    return cut;
}

} // namespace glcast::view
