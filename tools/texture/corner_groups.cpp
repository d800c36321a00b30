#include "tools/texture/corner_groups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace glcast {
namespace {

struct Group {
    glm::dvec3 normal{0}, colour{0}; ///< sums, by weight
    double weight = 0;
    std::uint32_t number = 0; ///< of its first corner around the vertex

    void add(const Group& other) {
        normal += other.normal, colour += other.colour;
        weight += other.weight;
    }
};

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

/// 1: just within the limits.
double disagreement(const Group& a, const Group& b, const JoinLimits& limits) {
    const glm::dvec3 off = glm::abs(a.colour / a.weight - b.colour / b.weight);
    return std::max(degrees_between(a.normal, b.normal) / limits.degrees,
                    std::max({off.x, off.y, off.z}) / limits.colour);
}

/// The corners of one vertex.
class Around {
  public:
    Around(const std::vector<FaceSums>& faces, const std::vector<glm::vec3>& normals, const JoinLimits& limits)
        : faces(faces), normals(normals), limits(limits) {}

    /// The group of each corner, 0, 1, ... by their first corners.
    const std::vector<std::uint32_t>& group(std::span<const std::uint32_t> corners,
                                            const std::vector<std::array<Group, 3>>& shown) {
        groups.clear();
        of.assign(corners.size(), 0);
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            of[i] = i;
            if (faces[corners[i] / 3].found == 0) continue;
            groups.push_back(shown[corners[i] / 3][corners[i] % 3]);
            groups.back().number = i;
        }
        while (join_best_pair()) {
        }
        for (std::uint32_t i = 0; i < corners.size(); ++i)
            if (faces[corners[i] / 3].found == 0) of[i] = most_alike(normals[corners[i] / 3]);
        number_in_order();
        return of;
    }

  private:
    bool join_best_pair() {
        double least = 1;
        std::size_t first = 0, second = 0;
        for (std::size_t a = 0; a < groups.size(); ++a)
            for (std::size_t b = a + 1; b < groups.size(); ++b)
                if (const double d = disagreement(groups[a], groups[b], limits); d < least)
                    least = d, first = a, second = b;
        if (second == 0) return false;
        std::replace(of.begin(), of.end(), groups[second].number, groups[first].number);
        groups[first].add(groups[second]);
        groups.erase(groups.begin() + std::ptrdiff_t(second));
        return true;
    }
    std::uint32_t most_alike(const glm::vec3& normal) const {
        std::uint32_t best = 0; // the first corner, where nothing is shown anywhere around
        double most = -2;
        for (const Group& group : groups)
            if (const double d = glm::dot(glm::normalize(group.normal), glm::dvec3(normal)); d > most)
                most = d, best = group.number;
        return best;
    }
    void number_in_order() {
        std::uint32_t next = 0;
        known.assign(of.size(), UINT32_MAX);
        for (std::uint32_t& g : of) {
            if (known[g] == UINT32_MAX) known[g] = next++;
            g = known[g];
        }
    }

    const std::vector<FaceSums>& faces;
    const std::vector<glm::vec3>& normals;
    const JoinLimits& limits;
    std::vector<Group> groups;
    std::vector<std::uint32_t> of, known;
};

/// What is shown at each corner of a triangle, over it alone.
std::array<Group, 3> shown_at(const FaceSums& face) {
    std::array<Group, 3> shown;
    if (face.found == 0) return shown;
    const auto normals = corner_values(face, face.normal), colours = corner_values(face, face.colour);
    for (int k = 0; k < 3; ++k) shown[k] = {normals[k] * face.found, colours[k] * face.found, face.found, 0};
    return shown;
}

} // namespace

std::vector<Triangle> group_corners(const Mesh& mesh, const Neighbours& neighbours,
                                    const std::vector<FaceSums>& faces, const std::vector<glm::vec3>& normals,
                                    const JoinLimits& limits, std::uint32_t& wedges) {
    std::vector<std::array<Group, 3>> shown(faces.size());
    tbb::parallel_for(std::size_t(0), faces.size(), [&](std::size_t t) { shown[t] = shown_at(faces[t]); });
    std::vector<Triangle> group_of(faces.size());
    std::vector<std::uint32_t> first(mesh.positions.size() + 1);
    tbb::enumerable_thread_specific<Around> around(faces, normals, limits);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, std::uint32_t(mesh.positions.size()), 256),
                      [&](const auto& range) {
                          Around& mine = around.local();
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                              const auto corners = neighbours.around(v);
                              const auto& groups = mine.group(corners, shown);
                              for (std::size_t i = 0; i < corners.size(); ++i) {
                                  group_of[corners[i] / 3][corners[i] % 3] = groups[i];
                                  first[v + 1] = std::max(first[v + 1], groups[i] + 1);
                              }
                          }
                      });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    wedges = first.back();
    for (std::size_t t = 0; t < group_of.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) group_of[t][k] += first[mesh.triangles[t][k]];
    return group_of;
}

} // namespace glcast
