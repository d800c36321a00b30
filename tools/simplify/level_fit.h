// A coarse mesh that is laid along the surface it came from, round by round. Internal.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tools/simplify/attributes.h"
#include "tools/simplify/corners.h"
#include "tools/simplify/crossing_guard.h"
#include "tools/simplify/sample_tree.h"

namespace glcast {

class LevelFit {
  public:
    /// Changes `level`, which must outlive this. `samples` are spread evenly over the surface, `spacing`
    /// apart, of which `surface` is a walk that must outlive this too. `back`: so many times as hard as
    /// lay() counts them, points of the level pull.
    LevelFit(Mesh& level, bool closed, std::vector<Sample>&& samples, double spacing,
             const SurfaceWalk& surface, double back = 1);

    /// Lays every sample on the level and points of the level on the surface; the sum of their squared
    /// distances, those of the level's points as if there were as many to an area as there are samples.
    double lay();

    /// Vertices towards the least sum. None goes farther from the surface than the surface around it is from
    /// the level: so none becomes a spike.
    void move_vertices();

    /// Edges that lessen the sum. Each vertex takes part in one swap at most, so that none undoes what
    /// another looked at.
    void swap_edges();

  private:
    /// Where a sample is laid on the level, or a point of the level is on it; what pulls there.
    struct Place {
        std::uint32_t triangle = 0;
        bool faces = false; ///< the triangle faces as the sample does; otherwise the sample does not pull
        glm::dvec3 weights{1, 0, 0};
        glm::dvec3 off{0};         ///< from there to the sample
        double squared = INFINITY; ///< distance
    };
    /// A point of the level, drawn to the surface.
    struct OnLevel {
        Place place;
        std::uint32_t near = 0; ///< sample
        double importance = 1;
    };
    struct Pull {
        double weight; ///< of the vertex
        double importance;
        glm::dvec3* off;
    };
    /// Two triangles, a b c and b a d, that may become a d c and d b c.
    struct Diamond {
        std::uint32_t left, right, a, b, c, d;
    };
    /// Lists of samples, by triangle.
    struct Laid {
        std::vector<std::uint32_t> first, samples;
        std::span<const std::uint32_t> operator()(std::uint32_t t) const {
            return std::span(samples).subspan(first[t], first[t + 1] - first[t]);
        }
    };
    struct Seen;

    void lay(const Sample& sample, Place& place) const;
    void look_around(const Sample& sample, std::uint32_t vertex, Place& best, Seen& seen) const;
    void look_at(const Sample& sample, std::uint32_t triangle, Place& best) const;
    void spread_over_level();
    double lay_level();

    void gather();
    void move(std::uint32_t v);
    void hold_back(std::vector<glm::dvec3>& wanted) const;
    void move_to(const std::vector<glm::dvec3>& wanted);
    bool move_guarded(std::uint32_t v, const glm::dvec3& to);
    bool keeps_shape(std::uint32_t v, const glm::dvec3& to) const;
    bool folds(const SurfaceChange& change) const;
    double sharpest(std::span<const Triangle> triangles, const SurfaceChange& change, bool made) const;

    Laid samples_by_triangle() const;
    bool are_joined(std::uint32_t v, std::uint32_t w) const;
    std::optional<Diamond> diamond_at(std::uint32_t t, std::size_t k) const;
    bool better_swapped(const Diamond& at, std::span<const std::uint32_t> laid_left,
                        std::span<const std::uint32_t> laid_right) const;
    double squares_of(const Corners& triangle, std::uint32_t near) const;

    CrossingGuard::Surface surface() const {
        return {mesh.positions,
                {mesh.triangles.empty() ? nullptr : mesh.triangles[0].data(), 3 * mesh.triangles.size()}};
    }

    Mesh& mesh;
    std::unique_ptr<SurfaceWalk> walk;
    std::vector<Sample> samples;
    double spacing, back;
    SampleTree tree;
    std::vector<Place> places; ///< of the samples
    std::vector<OnLevel> points;
    bool laid = false;                ///< `places` are those of the last round
    std::vector<Faced> faced;         ///< by triangle, as they were when samples were laid last
    std::vector<std::uint32_t> first; ///< per vertex, where its pulls begin; one more at the end
    std::vector<Pull> pulls;
    CrossingGuard guard;
};

} // namespace glcast
