// A part of a surface, and the collapse of its edges, cheapest first. Internal.
//
// Notation. Corner c = 3 t + k is corner k of triangle t; it is also the half-edge from vertex at[c] to the
// next corner's. twin[c] is the half-edge that runs the other way, none at the rim of the patch. Every edge
// between two vertices that are free has a number; edges at a vertex that is locked never collapse, so all
// that a collapse changes or asks about lies inside the patch. A surface with boundaries is closed by
// triangles to a vertex at infinity, the ghost, which is locked: then the link condition needs no word for
// boundaries (Dey, Edelsbrunner, Guha and Nekhayev 1999, "Topology preserving edge contraction").
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/mesh/mesh.h"
#include "tools/simplify/crossing_guard.h"
#include "tools/simplify/edge_queue.h"
#include "tools/simplify/quadric.h"

namespace glcast {

constexpr std::uint32_t none = UINT32_MAX;

/// One collapse, as a patch writes it down: in names of the patch until they are changed.
struct Step {
    std::uint32_t kept = 0, removed = 0;
    std::uint32_t source = 0; ///< a vertex of the original near `point`
    float cost = 0;
    glm::dvec3 point{0};
    bool at_boundary = false; ///< one triangle went, not two
};

/// What a collapse may do to the triangles around it. The first row keeps the shape; when it allows no more
/// and the target is not reached, the next takes over. The last asks for no more than a manifold that does not
/// pass through itself.
struct Strictness {
    double min_cosine;  ///< between a triangle's normal before and after
    double min_quality; ///< 1 is equilateral, 0 degenerate; what was worse already may stay as bad
};
constexpr Strictness strictness[] = {{0.2, 0.01}, {0.0, 1e-6}, {-2.0, 0.0}};

template <int N> class Patch {
  public:
    // By vertex:
    std::vector<glm::dvec3> position, source_at; ///< in a unit cube; source_at: where the source lies
    std::vector<std::uint32_t> source;
    std::vector<char> locked;
    std::vector<Quadric<N>> quadrics; ///< of a locked vertex: what collapses changed in its own
    std::uint32_t ghost = none;       ///< the vertex at infinity, the last
    bool keeps_volume = true;         ///< collapses keep the body's volume
    bool memoryless = true;           ///< planes are those of the triangles as they now are
    bool in_exact_order = true;       ///< or nearly so

    /// Once the above are filled: `corners` names three vertices a triangle.
    void connect(std::vector<std::uint32_t> corners);

    std::vector<float> costs() const; ///< of all edges

    /// Puts the edges that cost no more than `dearest` in order.
    void queue_edges(float dearest);
    /// Collapses the cheapest edge that may; false when there is none.
    bool collapse_cheapest(Step& step);
    /// From now on the surface must not pass through itself, where it does not yet.
    void keep_from_crossing();
    /// Less strict from now on; false when there is no less.
    bool relax();

    bool triangle_lives(std::uint32_t t) const { return at[3 * t] != none; }
    const std::uint32_t* triangle(std::uint32_t t) const { return &at[3 * t]; }

  private:
    static std::uint32_t next(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
    static std::uint32_t previous(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }
    std::uint32_t after(std::uint32_t c) const { return at[next(c)]; }

    /// Calls f with every half-edge out of a free vertex.
    template <typename F> void around(std::uint32_t v, const F& f) const {
        std::uint32_t c = out[v];
        do {
            f(c);
            c = twin[previous(c)];
        } while (c != out[v]);
    }

    void find_twins();
    void number_edges();
    Placement place_edge(std::uint32_t c) const;
    void push(std::uint32_t edge, double cost);
    glm::dvec3 keep_volume(std::uint32_t c, const glm::dvec3& point) const;
    bool keeps_manifold(std::uint32_t c);
    bool keeps_shape(std::uint32_t v, std::uint32_t other, const glm::dvec3& to) const;
    bool allowed(std::uint32_t c, const glm::dvec3& to);
    bool evade(std::uint32_t c, Placement& to);
    bool crosses(std::uint32_t c, const glm::dvec3& to);
    CrossingGuard::Surface guarded() const {
        return {std::span(position).first(std::min<std::size_t>(ghost, position.size())), at};
    }
    void refuse(std::uint32_t c);
    void remove_triangle(std::uint32_t c);
    void renew_planes(std::uint32_t c, const glm::dvec3& to);
    void collapse(std::uint32_t c, const Placement& to, Step& step);
    void queue_again(std::uint32_t edge);
    void queue_at(std::uint32_t v);

    std::vector<std::uint32_t> at, twin, edge; ///< by corner; at is none where the triangle is gone
    std::vector<std::uint32_t> out;            ///< by vertex: a half-edge out of it
    std::vector<std::uint32_t> mark;           ///< by vertex: for the link condition
    std::uint32_t marks = 0;
    std::optional<CrossingGuard> guard;
    SurfaceChange change;            ///< the last that the guard was asked about
    std::vector<std::uint32_t> half; ///< by edge: one of its half-edges, none when it is gone
    /// Every edge that lives and costs no more than `most` is here, once, or refused. A cost is taken
    /// anew when the edge comes to the top. Nearly all costs only grow as triangles do; one that has fallen
    /// waits a little longer than it should: putting all edges near a collapse in order at once gains 0.3 %
    /// of the error for a third more time.
    EdgeQueue queue;
    std::vector<char> refused;      ///< by edge: not allowed when its turn came
    std::vector<char> near_refused; ///< by vertex: it may have such an edge
    float most = 0;
    std::size_t stage = 0;
    bool crossed = false;        ///< why allowed() last said no
    std::size_t since_retry = 0; ///< collapses since all that was refused was tried again
};

extern template class Patch<0>;
extern template class Patch<3>;
extern template class Patch<6>;

} // namespace glcast
