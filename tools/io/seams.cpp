#include "tools/io/seams.h"

namespace glcast::format {
namespace {

bool any_differs(const std::vector<glm::vec3>& values, std::span<const std::uint32_t> originals, std::size_t first) {
    for (std::size_t k = 0; k < originals.size() && first + k < values.size(); ++k)
        if (values[first + k] != values[originals[k]]) return true;
    return false;
}

/// Those of the triangles' vertices, for the triangles that have none yet.
void complete(CornerValues& corners, const Mesh& mesh, const std::vector<glm::vec3>& values) {
    for (std::size_t t = corners.size(); t < mesh.triangles.size(); ++t) {
        const Triangle& at = mesh.triangles[t];
        corners.push_back({values[at[0]], values[at[1]], values[at[2]]});
    }
}

/// `values`: of the vertices, or none.
void join(std::vector<glm::vec3>& values, CornerValues& corners, const Mesh& mesh,
          std::span<const std::uint32_t> originals, std::size_t first) {
    if (values.size() < mesh.positions.size()) return;
    if (!corners.empty() || any_differs(values, originals, first)) complete(corners, mesh, values);
    values.resize(first);
}

} // namespace

bool are_copies(const Mesh& mesh, std::span<const std::uint32_t> originals) {
    if (originals.size() >= mesh.positions.size()) return false;
    const std::size_t first = mesh.positions.size() - originals.size();
    for (std::size_t k = 0; k < originals.size(); ++k)
        if (originals[k] >= first || mesh.positions[originals[k]] != mesh.positions[first + k]) return false;
    return true;
}

void CopyJoiner::join(Mesh& mesh, std::span<const std::uint32_t> originals) {
    const std::size_t first = mesh.positions.size() - originals.size();
    format::join(mesh.normals, normals, mesh, originals, first);
    format::join(mesh.colours, colours, mesh, originals, first);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t)
            if (v >= first) v = originals[v - first];
    mesh.positions.resize(first);
}

Wedges CopyJoiner::wedges(Mesh& mesh) {
    if (mesh.normals.empty()) normals.clear();
    if (mesh.colours.empty()) colours.clear();
    if (!normals.empty()) complete(normals, mesh, mesh.normals);
    if (!colours.empty()) complete(colours, mesh, mesh.colours);
    return normals.empty() && colours.empty() ? Wedges{} : take_corner_values(mesh, normals, colours);
}

} // namespace glcast::format
