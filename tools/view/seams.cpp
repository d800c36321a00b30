#include "tools/view/seams.h"

#include <map>
#include <stdexcept>
#include <tuple>

namespace glcast::view {
namespace {

using Corner = std::tuple<std::uint32_t, float, float, float, float, float, float>;

} // namespace

CutMesh cut_at_seams(const Mesh& mesh, std::span<const double> distance, const Texture& texture) {
    const bool bent = !texture.tangents.empty();
    if (texture.coordinates.size() != mesh.triangles.size() ||
        (bent && texture.tangents.size() != mesh.triangles.size()))
        throw std::runtime_error("cannot show the texture: it is not one of its mesh");
    CutMesh cut;
    std::map<Corner, std::uint32_t> numbers;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle triangle = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = triangle[k];
            const glm::vec2 at = texture.coordinates[t][k];
            const glm::vec4 tangent = bent ? texture.tangents[t][k] : glm::vec4(1, 0, 0, 1);
            const Corner corner{v, at.x, at.y, tangent.x, tangent.y, tangent.z, tangent.w};
            const auto [found, is_new] =
                numbers.try_emplace(corner, std::uint32_t(cut.mesh.positions.size()));
            triangle[k] = found->second;
            if (!is_new) continue;
            cut.mesh.positions.push_back(mesh.positions.at(v));
            if (!mesh.normals.empty()) cut.mesh.normals.push_back(mesh.normals[v]);
            if (!mesh.colours.empty()) cut.mesh.colours.push_back(mesh.colours[v]);
            cut.distance.push_back(distance[v]);
            cut.coordinates.push_back(at);
            cut.tangents.push_back(tangent);
        }
        cut.mesh.triangles.push_back(triangle);
    }
    return cut;
}

} // namespace glcast::view
