#include "tools/progressive/openmesh_pm.h"

#include <bit>
#include <glm/geometric.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX; ///< OpenMesh's -1: no triangle on that side

class Bytes {
  public:
    explicit Bytes(OutputFile& target) : file(target) {}
    void put(std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8) buffer.push_back(char(std::uint8_t(value >> shift)));
        if (buffer.size() > 1u << 20) flush();
    }
    void put(const glm::dvec3& p) {
        for (int k = 0; k < 3; ++k) put(std::bit_cast<std::uint32_t>(float(p[k])));
    }
    void text(const char* word) { buffer += word; }
    void flush() {
        if (!file.append(buffer.data(), buffer.size())) throw std::runtime_error(file.error());
        buffer.clear();
    }

  private:
    OutputFile& file;
    std::string buffer;
};

std::vector<glm::dvec3> original_positions(ProgressiveMesh& mesh) {
    mesh.refine_to(mesh.splits());
    std::vector<glm::dvec3> positions(mesh.vertices(mesh.splits()));
    for (std::uint32_t v = 0; v < positions.size(); ++v) positions[v] = mesh.vertex(v).position;
    return positions;
}

/// Which vertex of the original stands for each vertex of a level: of two that become one, the nearer to it.
struct Stand {
    std::vector<std::uint32_t> base;  ///< for the vertices of the base, by number
    std::vector<bool> new_stays;      ///< a split: what stood for both stands for the new vertex from then on
    std::vector<std::uint32_t> comes; ///< a split: what stands for the other from then on
};

/// Leaves the mesh at its base level.
Stand choose(ProgressiveMesh& mesh, const std::vector<glm::dvec3>& original) {
    std::vector<std::uint32_t> stands(original.size());
    std::iota(stands.begin(), stands.end(), 0u);
    Stand stand{{}, std::vector<bool>(mesh.splits()), std::vector<std::uint32_t>(mesh.splits())};
    for (std::size_t split = mesh.splits(); split-- > 0;) {
        mesh.refine_to(split);
        const std::uint32_t kept = mesh.kept_of(split), added = std::uint32_t(mesh.vertices(split));
        const glm::dvec3 place = mesh.vertex(kept).position;
        const auto distance = [&](std::uint32_t v) { return glm::length(original[stands[v]] - place); };
        stand.new_stays[split] = distance(added) < distance(kept);
        stand.comes[split] = stands[stand.new_stays[split] ? kept : added];
        if (stand.new_stays[split]) stands[kept] = stands[added];
    }
    stands.resize(mesh.vertices(0));
    stand.base = std::move(stands);
    return stand;
}

/// Apex of the triangle in which `to` comes after `from`, among those that the split brings.
std::uint32_t apex_at(const ProgressiveMesh& mesh, std::size_t split, std::uint32_t from, std::uint32_t to) {
    std::uint32_t apex = none;
    for (std::size_t t = mesh.triangles(split); t < mesh.triangles(split + 1); ++t) {
        const Triangle& corners = mesh.triangle(std::uint32_t(t));
        for (std::size_t k = 0; k < 3; ++k)
            if (corners[k] == from && corners[(k + 1) % 3] == to) {
                if (apex != none)
                    throw std::runtime_error("a mesh that is no two-manifold cannot be written as .pm");
                apex = corners[(k + 2) % 3];
            }
    }
    return apex;
}

void put_base(Bytes& out, const ProgressiveMesh& mesh, const std::vector<glm::dvec3>& original,
              const Stand& stand) {
    out.text("ProgMesh");
    for (const std::size_t count : {mesh.vertices(0), mesh.triangles(0), mesh.splits()})
        out.put(std::uint32_t(count));
    for (const std::uint32_t vertex : stand.base) out.put(original[vertex]);
    for (std::size_t t = 0; t < mesh.triangles(0); ++t)
        for (const std::uint32_t corner : mesh.triangle(std::uint32_t(t))) out.put(corner);
}

void put_splits(Bytes& out, ProgressiveMesh& mesh, const std::vector<glm::dvec3>& original,
                const Stand& stand) {
    std::vector<std::uint32_t> name(original.size()); // in the file, of our vertices
    std::iota(name.begin(), name.end(), 0u);
    for (std::size_t split = 0; split < mesh.splits(); ++split) {
        std::uint32_t stays = mesh.kept_of(split), comes = std::uint32_t(mesh.vertices(split));
        if (stand.new_stays[split]) {
            std::swap(name[stays], name[comes]);
            std::swap(stays, comes);
        }
        const std::uint32_t left = apex_at(mesh, split, comes, stays),
                            right = apex_at(mesh, split, stays, comes);
        if (left == none && right == none)
            throw std::runtime_error("a vertex split that brings no triangle cannot be written as .pm");
        out.put(original[stand.comes[split]]);
        out.put(name[stays]);
        out.put(left == none ? none : name[left]);
        out.put(right == none ? none : name[right]);
        mesh.refine_to(split + 1);
    }
}

} // namespace

void write_openmesh_pm(OutputFile& file, ProgressiveMesh& mesh) {
    const std::size_t level = mesh.level();
    const std::vector<glm::dvec3> original = original_positions(mesh);
    const Stand stand = choose(mesh, original);
    Bytes out(file);
    put_base(out, mesh, original, stand);
    put_splits(out, mesh, original, stand);
    out.flush();
    mesh.refine_to(level);
}

} // namespace glcast
