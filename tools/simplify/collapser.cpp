// Garland and Heckbert 1997, "Surface simplification using quadric error metrics".
//
// OpenMesh's own DecimaterT collapses half-edges, so that vertices can only stay where they are, and it
// leaves the priorities of edges into a grown vertex stale. This one places the new vertex where the quadric
// is least and keeps every priority true. Mesh, link condition, quadrics and heap are OpenMesh's.
#include "tools/simplify/collapser.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// After the mesh: it uses vector_traits without including them.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <queue>
#include <stdexcept>

namespace glcast {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using VertexHandle = HalfEdgeMesh::VertexHandle;
using EdgeHandle = HalfEdgeMesh::EdgeHandle;
using HalfedgeHandle = HalfEdgeMesh::HalfedgeHandle;
using OpenMesh::Vec3d;
using Quadric = OpenMesh::Geometry::Quadricd;

// What a collapse may do to the triangles around it. The first row keeps the shape; when it allows no more
// and the target is not reached, the next takes over. The last asks for nothing but a manifold.
struct Strictness {
    double min_cosine;  ///< between a triangle's normal before and after
    double min_quality; ///< 1 is equilateral, 0 degenerate; what was worse already may stay as bad
};
constexpr Strictness strictness[] = {{0.2, 0.01}, {0.0, 1e-6}, {-2.0, 0.0}};

// Where a quadric does not care (along a plane or a crease), the new vertex stays at the middle of the edge.
// Relative to the quadric's trace: far above the rounding of doubles, far below any bend worth keeping.
constexpr double stay_near_middle = 1e-6;
// In flat places all collapses cost nothing; short edges first makes the better triangles. Relative as above;
// at a lattice of 256 it outweighs noise of 1e-4 samples and is outweighed by any curvature.
constexpr double prefer_short_edges = 1e-7;

// Of a boundary's planes against those of the triangles beside it.
constexpr double boundary_weight = 1;

double quality(const Vec3d& a, const Vec3d& b, const Vec3d& c, double doubled_area) {
    const double squares = (b - a).sqrnorm() + (c - b).sqrnorm() + (a - c).sqrnorm();
    return squares > 0 ? 2 * std::sqrt(3.0) * doubled_area / squares : 0;
}

/// Minus half the quadric's gradient.
Vec3d pull(const Quadric& q, const Vec3d& p) {
    return {-(q.xx() * p[0] + q.xy() * p[1] + q.xz() * p[2] + q.xw()),
            -(q.xy() * p[0] + q.yy() * p[1] + q.yz() * p[2] + q.yw()),
            -(q.xz() * p[0] + q.yz() * p[1] + q.zz() * p[2] + q.zw())};
}

/// Where the quadric, held near the middle, is least. The second step is held near the first one's end: it
/// takes away what the hold did to the directions in which the quadric does care, so that corners stay exact.
Vec3d least(const Quadric& q, const Vec3d& middle) {
    const double hold = stay_near_middle * (q.xx() + q.yy() + q.zz());
    const double xx = q.xx() + hold, yy = q.yy() + hold, zz = q.zz() + hold;
    const double c00 = yy * zz - q.yz() * q.yz(), c01 = q.xz() * q.yz() - q.xy() * zz,
                 c02 = q.xy() * q.yz() - q.xz() * yy, c11 = xx * zz - q.xz() * q.xz(),
                 c12 = q.xy() * q.xz() - xx * q.yz(), c22 = xx * yy - q.xy() * q.xy();
    const double determinant = xx * c00 + q.xy() * c01 + q.xz() * c02;
    if (!(determinant > 0)) return middle;
    Vec3d p = middle;
    for (int step = 0; step < 2; ++step) {
        const Vec3d b = pull(q, p);
        p += Vec3d(c00 * b[0] + c01 * b[1] + c02 * b[2], c01 * b[0] + c11 * b[1] + c12 * b[2],
                   c02 * b[0] + c12 * b[1] + c22 * b[2]) /
             determinant;
    }
    return p;
}

struct Placement {
    Vec3d point;
    double cost;
};

/// Cost and edge in one number that sorts by cost, then by edge: floats that are not negative sort like their
/// bits. Half the size of a pair, and a heap of plain numbers is several times as fast as one that looks
/// costs up.
using Entry = std::uint64_t;
Entry entry_of(double cost, EdgeHandle edge) {
    return Entry(std::bit_cast<std::uint32_t>(float(cost))) << 32 | std::uint32_t(edge.idx());
}
EdgeHandle edge_of(Entry entry) { return EdgeHandle(int(entry & UINT32_MAX)); }

} // namespace

struct Collapser::Impl {
    const Mesh& original;
    HalfEdgeMesh mesh; ///< in a unit cube about 0; vertex i is the original's vertex i while it lives
    glm::dvec3 centre{0};
    double scale = 1;
    std::vector<Quadric> quadrics;
    std::vector<std::uint32_t> sources;
    std::vector<std::uint32_t> merged_into; ///< itself while a vertex lives
    std::vector<bool> moved;
    /// Every edge that lives is here, once, or refused. Costs only grow as quadrics are added up, so a cost
    /// that is out of date is a lower bound: it is enough to take it anew when the edge comes to the top.
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    std::vector<bool> refused;      ///< by edge: not allowed when its turn came
    std::vector<bool> near_refused; ///< by vertex: it may have such an edge
    std::size_t live_triangles = 0, live_edges = 0;
    std::size_t stage = 0;

    explicit Impl(const Mesh& from) : original(from) {}

    Vec3d inside(const glm::dvec3& p) const {
        const glm::dvec3 q = (p - centre) * scale;
        return {q.x, q.y, q.z};
    }

    void fit_to_unit_cube() {
        glm::dvec3 low(original.positions.at(0)), high(low);
        for (const glm::dvec3& p : original.positions) low = min(low, p), high = max(high, p);
        centre = (low + high) * 0.5;
        const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        scale = extent > 0 ? 1 / extent : 1;
    }

    void build_connectivity() {
        const std::size_t faces = original.triangles.size();
        mesh.reserve(original.positions.size(), faces * 3 / 2, faces);
        for (const glm::dvec3& p : original.positions) mesh.add_vertex(inside(p));
        for (const Triangle& t : original.triangles) {
            const auto face =
                mesh.add_face(VertexHandle(int(t[0])), VertexHandle(int(t[1])), VertexHandle(int(t[2])));
            if (!face.is_valid()) throw std::runtime_error("cannot simplify: the mesh is not a two-manifold");
        }
        live_triangles = faces;
        live_edges = mesh.n_edges();
    }

    void build_quadrics() {
        quadrics.resize(mesh.n_vertices());
        for (const Triangle& t : original.triangles) {
            const Vec3d a = mesh.point(VertexHandle(int(t[0])));
            Vec3d normal =
                (mesh.point(VertexHandle(int(t[1]))) - a) % (mesh.point(VertexHandle(int(t[2]))) - a);
            const double doubled_area = normal.norm();
            if (doubled_area <= 0) continue;
            normal /= doubled_area;
            Quadric q(normal[0], normal[1], normal[2], -(normal | a));
            q *= doubled_area / 2;
            for (const std::uint32_t corner : t) quadrics[corner] += q;
        }
        for (const HalfedgeHandle half : mesh.halfedges())
            if (mesh.is_boundary(half)) hold_boundary(mesh.opposite_halfedge_handle(half));
    }

    /// A plane through the edge of a boundary, square to its triangle (Garland and Heckbert, section 6).
    void hold_boundary(HalfedgeHandle half) {
        const VertexHandle v0 = mesh.from_vertex_handle(half), v1 = mesh.to_vertex_handle(half);
        const Vec3d a = mesh.point(v0), along = mesh.point(v1) - a;
        Vec3d outwards = along % (along % (mesh.point(mesh.opposite_vh(half)) - a));
        const double length = outwards.norm();
        if (length <= 0) return;
        outwards /= length;
        Quadric q(outwards[0], outwards[1], outwards[2], -(outwards | a));
        q *= boundary_weight * along.sqrnorm();
        quadrics[v0.idx()] += q;
        quadrics[v1.idx()] += q;
    }

    Placement place(EdgeHandle edge) const {
        const HalfedgeHandle half = mesh.halfedge_handle(edge, 0);
        const VertexHandle v0 = mesh.from_vertex_handle(half), v1 = mesh.to_vertex_handle(half);
        const Vec3d p0 = mesh.point(v0), p1 = mesh.point(v1), middle = (p0 + p1) * 0.5;
        const double squared_length = (p1 - p0).sqrnorm();
        Quadric q = quadrics[v0.idx()];
        q += quadrics[v1.idx()];
        const double shape = prefer_short_edges * (q.xx() + q.yy() + q.zz()) * squared_length;
        const Vec3d point = least(q, middle);
        Placement best{point, q(point)};
        if ((point - middle).sqrnorm() > 4 * squared_length) { // far off: two planes almost parallel
            best = {middle, q(middle)};
            for (const Vec3d& p : {p0, p1})
                if (const double at = q(p); at < best.cost) best = {p, at};
        }
        best.cost = std::max(best.cost, 0.0) + shape;
        return best;
    }

    void build_heap() {
        std::vector<Entry> entries;
        entries.reserve(mesh.n_edges());
        for (const EdgeHandle edge : mesh.edges()) entries.push_back(entry_of(place(edge).cost, edge));
        heap = decltype(heap)({}, std::move(entries));
        refused.assign(mesh.n_edges(), false);
        near_refused.assign(mesh.n_vertices(), false);
    }

    void refuse(EdgeHandle edge, HalfedgeHandle half) {
        refused[edge.idx()] = true;
        near_refused[mesh.from_vertex_handle(half).idx()] = true;
        near_refused[mesh.to_vertex_handle(half).idx()] = true;
    }

    void queue_again(EdgeHandle edge) {
        if (!refused[edge.idx()]) return;
        refused[edge.idx()] = false;
        heap.push(entry_of(place(edge).cost, edge));
    }

    /// The link condition, and never a tetrahedron: that would leave two triangles back to back.
    bool keeps_manifold(HalfedgeHandle half) {
        if (!mesh.is_collapse_ok(half)) return false;
        if (mesh.is_boundary(mesh.edge_handle(half))) return true;
        const VertexHandle left = mesh.opposite_vh(half);
        const VertexHandle right = mesh.opposite_vh(mesh.opposite_halfedge_handle(half));
        return !(mesh.valence(left) == 3 && mesh.valence(right) == 3 &&
                 mesh.find_halfedge(left, right).is_valid());
    }

    /// May the triangles around `v`, but for those that hold `other`, be led to `to` instead?
    bool keeps_shape(VertexHandle v, VertexHandle other, const Vec3d& to) const {
        const Strictness& rule = strictness[stage];
        const Vec3d from = mesh.point(v);
        for (auto half = mesh.cvoh_iter(v); half.is_valid(); ++half) {
            if (mesh.is_boundary(*half)) continue;
            const VertexHandle b = mesh.to_vertex_handle(*half);
            const VertexHandle c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*half));
            if (b == other || c == other) continue;
            const Vec3d pb = mesh.point(b), pc = mesh.point(c);
            const Vec3d before = (pb - from) % (pc - from), after = (pb - to) % (pc - to);
            const double area_before = before.norm(), area_after = after.norm();
            if ((before | after) < rule.min_cosine * area_before * area_after) return false;
            const double good = quality(to, pb, pc, area_after);
            if (good < rule.min_quality && good < quality(from, pb, pc, area_before)) return false;
        }
        return true;
    }

    bool allowed(HalfedgeHandle half, const Vec3d& to) {
        const VertexHandle v0 = mesh.from_vertex_handle(half), v1 = mesh.to_vertex_handle(half);
        if (!keeps_manifold(half)) return false;
        return stage + 1 == std::size(strictness) || (keeps_shape(v0, v1, to) && keeps_shape(v1, v0, to));
    }

    void collapse(HalfedgeHandle half, const Vec3d& to) {
        const VertexHandle gone = mesh.from_vertex_handle(half), kept = mesh.to_vertex_handle(half);
        const auto away = [&](VertexHandle v) {
            return (inside(original.positions[sources[v.idx()]]) - to).sqrnorm();
        };
        if (away(gone) < away(kept)) sources[kept.idx()] = sources[gone.idx()];
        quadrics[kept.idx()] += quadrics[gone.idx()];
        merged_into[std::size_t(gone.idx())] = std::uint32_t(kept.idx());
        const bool at_boundary = mesh.is_boundary(mesh.edge_handle(half));
        mesh.collapse(half);
        mesh.set_point(kept, to);
        moved[kept.idx()] = true;
        live_triangles -= at_boundary ? 1 : 2;
        live_edges -= at_boundary ? 2 : 3;
        near_refused[kept.idx()] = near_refused[kept.idx()] || near_refused[gone.idx()];
        queue_around(kept);
    }

    /// What was refused near `v` may be allowed now.
    void queue_around(VertexHandle v) {
        queue_at(v);
        for (auto near = mesh.cvv_iter(v); near.is_valid(); ++near) queue_at(*near);
    }
    void queue_at(VertexHandle v) {
        if (!near_refused[v.idx()]) return;
        for (auto edge = mesh.cve_iter(v); edge.is_valid(); ++edge) queue_again(*edge);
        near_refused[v.idx()] = false;
    }

    void relax() {
        ++stage;
        for (const EdgeHandle edge : mesh.edges()) queue_again(edge); // skips what is deleted
    }

    bool collapse_cheapest() {
        while (!heap.empty()) {
            const EdgeHandle edge = edge_of(heap.top());
            heap.pop();
            if (mesh.status(edge).deleted()) continue;
            const Placement placement = place(edge);
            const Entry entry = entry_of(placement.cost, edge);
            if (!heap.empty() && entry > heap.top()) {
                heap.push(entry);
                continue;
            }
            const HalfedgeHandle half = mesh.halfedge_handle(edge, 0);
            if (allowed(half, placement.point)) {
                collapse(half, placement.point);
                return true;
            }
            refuse(edge, half);
        }
        return false;
    }
};

Collapser::Collapser(const Mesh& mesh) : impl(std::make_unique<Impl>(mesh)) {
    impl->fit_to_unit_cube();
    impl->build_connectivity();
    impl->build_quadrics();
    impl->sources.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < impl->sources.size(); ++v) impl->sources[v] = v;
    impl->merged_into = impl->sources;
    impl->moved.assign(mesh.positions.size(), false);
    impl->build_heap();
}

Collapser::~Collapser() = default;

void Collapser::reduce_to(const Limit& limit) {
    while (impl->live_triangles > limit.triangles || impl->live_edges > limit.edges) {
        if (impl->collapse_cheapest()) continue;
        if (impl->stage + 1 == std::size(strictness)) return;
        impl->relax();
    }
}

Collapser::Remainder Collapser::remainder() {
    constexpr std::uint32_t unused = UINT32_MAX;
    Remainder result;
    std::vector<std::uint32_t> renumbered(impl->original.positions.size(), unused);
    result.triangles.reserve(impl->live_triangles);
    for (const auto face : impl->mesh.faces()) {
        Triangle triangle{};
        std::size_t corner = 0;
        for (const auto v : impl->mesh.fv_range(face)) {
            std::uint32_t& number = renumbered[std::size_t(v.idx())];
            if (number == unused) {
                number = std::uint32_t(result.positions.size());
                const Vec3d p = impl->mesh.point(v);
                result.positions.push_back(impl->moved[std::size_t(v.idx())]
                                               ? glm::dvec3(p[0], p[1], p[2]) / impl->scale + impl->centre
                                               : impl->original.positions[std::size_t(v.idx())]);
                result.sources.push_back(impl->sources[std::size_t(v.idx())]);
            }
            triangle[corner++] = number;
        }
        result.triangles.push_back(triangle);
    }
    std::vector<std::uint32_t>& into = impl->merged_into; // chains are shortened on the way
    for (std::uint32_t v = 0; v < into.size(); ++v) {
        while (into[v] != into[into[v]]) into[v] = into[into[v]];
        result.became.push_back(renumbered[into[v]]);
    }
    return result;
}

} // namespace glcast
