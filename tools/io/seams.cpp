#include "tools/io/seams.h"

#include <algorithm>
#include <numeric>

namespace glcast::format {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// For each vertex that there was, the first of its copies.
std::vector<std::uint32_t> firsts(const Copies& copies) {
    std::vector<std::uint32_t> found(copies.count, none);
    for (std::size_t k = copies.of.size(); k-- > 0;) found[copies.of[k]] = std::uint32_t(copies.first + k);
    return found;
}

bool any_differs(const std::vector<glm::vec3>& values, const Copies& copies, const std::vector<std::uint32_t>& first) {
    for (std::size_t k = 0; k < copies.of.size(); ++k)
        if (values[copies.first + k] != values[first[copies.of[k]]]) return true;
    return false;
}

/// Those of the triangles' vertices, for the triangles that have none yet.
void complete(CornerValues& corners, const Mesh& mesh, const std::vector<glm::vec3>& values) {
    for (std::size_t t = corners.size(); t < mesh.triangles.size(); ++t) {
        const Triangle& at = mesh.triangles[t];
        corners.push_back({values[at[0]], values[at[1]], values[at[2]]});
    }
}

template <class Value>
void take(std::vector<Value>& values, std::size_t from, const std::vector<std::uint32_t>& which) {
    std::vector<Value> taken;
    for (const std::uint32_t v : which) taken.push_back(values[v]);
    values.resize(from);
    values.insert(values.end(), taken.begin(), taken.end());
}

/// `values`: of the vertices, or none.
void join(std::vector<glm::vec3>& values, CornerValues& corners, const Mesh& mesh, const Copies& copies,
          const std::vector<std::uint32_t>& first) {
    if (values.size() < mesh.positions.size()) return;
    if (!corners.empty() || any_differs(values, copies, first)) complete(corners, mesh, values);
    take(values, copies.first, first);
}

} // namespace

Copies copies_at_end(const Mesh& mesh, std::span<const std::uint32_t> originals) {
    Copies copies;
    copies.count = mesh.positions.size() - std::min(mesh.positions.size(), originals.size());
    copies.of.resize(copies.count);
    std::iota(copies.of.begin(), copies.of.end(), 0);
    copies.of.insert(copies.of.end(), originals.begin(), originals.end());
    return copies;
}

bool are_copies(const Mesh& mesh, const Copies& copies) {
    if (copies.count == 0 || copies.first + copies.of.size() != mesh.positions.size()) return false;
    if (std::any_of(copies.of.begin(), copies.of.end(), [&](std::uint32_t v) { return v >= copies.count; })) return false;
    const std::vector<std::uint32_t> first = firsts(copies);
    if (std::find(first.begin(), first.end(), none) != first.end()) return false;
    for (std::size_t k = 0; k < copies.of.size(); ++k)
        if (mesh.positions[copies.first + k] != mesh.positions[first[copies.of[k]]]) return false;
    return true;
}

void CopyJoiner::join(Mesh& mesh, const Copies& copies) {
    const std::vector<std::uint32_t> first = firsts(copies);
    format::join(mesh.normals, normals, mesh, copies, first);
    format::join(mesh.colours, colours, mesh, copies, first);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t)
            if (v >= copies.first) v = std::uint32_t(copies.first + copies.of[v - copies.first]);
    take(mesh.positions, copies.first, first);
}

Wedges CopyJoiner::wedges(Mesh& mesh) {
    if (mesh.normals.empty()) normals.clear();
    if (mesh.colours.empty()) colours.clear();
    if (!normals.empty()) complete(normals, mesh, mesh.normals);
    if (!colours.empty()) complete(colours, mesh, mesh.colours);
    return normals.empty() && colours.empty() ? Wedges{} : take_corner_values(mesh, normals, colours);
}

} // namespace glcast::format
