// A mesh as a coarse one and the vertex splits that lead from it to the original, through every level between
// (Hoppe 1996, "Progressive meshes").
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/simplify/collapse_log.h"

namespace glcast {

/// Level k is the base mesh after k splits; level splits() is the original. Every level equals
/// `collapsed(mesh, log, log.size() - k)` bit for bit: vertices, triangles and corners in the order of the
/// original. Vertices and triangles are numbered here in the order in which splits bring them, so that a
/// level is the first so many of each. Memory: about 112 bytes per vertex of the original, 160 with colours
/// and normals.
class ProgressiveMesh {
  public:
    struct Vertex {
        glm::dvec3 position{0};
        glm::vec3 colour{0}, normal{0}; ///< left out of account where the mesh has none
    };

    /// One vertex becomes two: `kept`, which stays, and a new one, which takes the next number.
    struct Split {
        std::uint32_t kept = 0, vertex_id = 0;   ///< vertex_id: of the new vertex, its index in the original
        Vertex kept_fine, added;                 ///< what the two are after the split
        std::vector<std::uint32_t> moved;        ///< triangles whose corner `kept` becomes the new vertex
        std::vector<Triangle> triangles;         ///< new: with both of them as corners
        std::vector<std::uint32_t> triangle_ids; ///< of the new triangles, their index in the original
    };

    /// A mesh of one level: the base, which append() refines. `vertex_ids` and `triangle_ids` are indices in
    /// the original, growing.
    ProgressiveMesh(Mesh base, std::vector<std::uint32_t> vertex_ids,
                    std::vector<std::uint32_t> triangle_ids);

    /// At the base level. `mesh` must be a two-manifold, closed or with boundaries. Throws
    /// std::runtime_error, one line, where the log is not one of this mesh.
    ProgressiveMesh(const Mesh& mesh, std::span<const Collapse> log);

    /// One more split, behind the last; only at the finest level, and it stays the finest. The split must be
    /// one of this mesh.
    void append(const Split& split);

    std::size_t splits() const { return kept.size(); }
    std::size_t level() const { return at; }

    /// Forward or back: time and nothing else in proportion to what changes. `level` is at most splits().
    void refine_to(std::size_t level);

    std::size_t vertices(std::size_t level) const { return base_vertices + level; }
    std::size_t triangles(std::size_t level) const {
        return level ? triangle_end[level - 1] : base_triangles;
    }
    std::size_t
    edges(std::size_t level) const; ///< of a two-manifold, by Euler: a split adds one, and one a triangle

    // The finest level with at most so many; the base level where even that has more.
    std::size_t level_of_vertices(std::size_t most) const;
    std::size_t level_of_edges(std::size_t most) const;
    std::size_t level_of_triangles(std::size_t most) const;

    bool has_colours() const { return !now.colours.empty(); }
    bool has_normals() const { return !now.normals.empty(); }

    /// The level that it is at, in the order of the original; linear in its size.
    Mesh mesh() const;
    /// Numbers of the vertices of mesh(), in its order.
    std::vector<std::uint32_t> vertex_order() const;

    // By number, at the level that it is at. Of what comes with later splits: as it will be when it comes.
    Vertex vertex(std::uint32_t number) const;
    const Triangle& triangle(std::uint32_t number) const { return now.triangles[number]; }
    std::uint32_t vertex_id(std::uint32_t number) const { return vertex_ids[number]; }
    std::uint32_t triangle_id(std::uint32_t number) const { return triangle_ids[number]; }
    std::uint32_t kept_of(std::size_t split) const { return kept[split]; }
    /// What `kept` of a split is on the other side of it: finer while the split is to come, coarser once it
    /// is made.
    Vertex other_of(std::size_t split) const;
    /// Triangles whose corner `kept` becomes the new vertex.
    std::span<const std::uint32_t> moved_by(std::size_t split) const;

    std::size_t bytes() const; ///< of memory taken
    void shrink();             ///< gives back the memory that was taken for further splits

  private:
    void forward();
    void back();
    void swap_kept();
    void count_base_edges();
    void collapse_all(std::span<const Collapse> log, std::vector<std::uint32_t>& vertex_split,
                      std::vector<std::uint32_t>& triangle_split);
    void number_by_split(std::vector<std::uint32_t>& vertex_split,
                         std::vector<std::uint32_t>& triangle_split);

    /// By number. Only what the level has is as it is; the rest waits as it will be when it comes.
    Mesh now;
    std::vector<std::uint32_t> vertex_ids, triangle_ids;
    std::size_t base_vertices = 0, base_triangles = 0, base_edges = 0, at = 0;

    // Per split.
    std::vector<std::uint32_t> kept, triangle_end, moved_end;
    std::vector<std::uint32_t> moved; ///< of all splits, each behind the one before
    std::vector<glm::dvec3> other_positions;
    std::vector<glm::vec3> other_colours, other_normals;
};

} // namespace glcast
