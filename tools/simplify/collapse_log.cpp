#include "tools/simplify/collapse_log.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace glcast {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// A mesh that is collapsed. Each vertex heads a list of its corners (3 t + k); a merge joins two lists.
class Replay {
  public:
    explicit Replay(const Mesh& from)
        : mesh(from), first(from.positions.size(), none), last(first), next(from.triangles.size() * 3, none),
          vertex_gone(from.positions.size(), false), triangle_gone(from.triangles.size(), false) {
        for (std::uint32_t corner = 0; corner < next.size(); ++corner) {
            const std::uint32_t v = mesh.triangles[corner / 3][corner % 3];
            if (v >= first.size()) throw std::runtime_error("cannot collapse: a triangle names no vertex");
            append(v, corner, corner);
        }
    }

    void apply(const Collapse& step, std::size_t number) {
        const std::uint32_t kept = step.kept, removed = step.removed;
        if (kept >= first.size() || removed >= first.size() || kept == removed || vertex_gone[kept] ||
            vertex_gone[removed])
            fail(number);
        if (const int gone = lead_over(removed, kept); gone < 1 || gone > 2) fail(number);
        vertex_gone[removed] = true;
        mesh.positions[kept] = step.position;
        if (!mesh.colours.empty()) mesh.colours[kept] = step.colour;
        if (!mesh.normals.empty()) mesh.normals[kept] = step.normal;
    }

    /// What is left, closed up.
    Mesh finish() {
        std::vector<std::uint32_t> number(first.size(), none);
        std::uint32_t count = 0;
        for (std::uint32_t v = 0; v < number.size(); ++v) {
            if (vertex_gone[v]) continue;
            mesh.positions[count] = mesh.positions[v];
            if (!mesh.colours.empty()) mesh.colours[count] = mesh.colours[v];
            if (!mesh.normals.empty()) mesh.normals[count] = mesh.normals[v];
            number[v] = count++;
        }
        mesh.positions.resize(count);
        if (!mesh.colours.empty()) mesh.colours.resize(count);
        if (!mesh.normals.empty()) mesh.normals.resize(count);
        std::size_t kept = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (triangle_gone[t]) continue;
            const Triangle& was = mesh.triangles[t];
            mesh.triangles[kept++] = {number[was[0]], number[was[1]], number[was[2]]};
        }
        mesh.triangles.resize(kept);
        return std::move(mesh);
    }

  private:
    void append(std::uint32_t v, std::uint32_t head, std::uint32_t tail) {
        (first[v] == none ? first[v] : next[last[v]]) = head;
        last[v] = tail;
    }

    /// The corners of `removed` become corners of `kept`; how many triangles had both and are gone.
    int lead_over(std::uint32_t removed, std::uint32_t kept) {
        int gone = 0;
        std::uint32_t following = none;
        for (std::uint32_t corner = first[removed]; corner != none; corner = following) {
            following = next[corner];
            if (triangle_gone[corner / 3]) continue;
            Triangle& t = mesh.triangles[corner / 3];
            if (t[0] == kept || t[1] == kept || t[2] == kept) {
                triangle_gone[corner / 3] = true;
                ++gone;
                continue;
            }
            t[corner % 3] = kept;
            next[corner] = none;
            append(kept, corner, corner);
        }
        return gone;
    }

    [[noreturn]] static void fail(std::size_t number) {
        throw std::runtime_error("cannot collapse: step " + std::to_string(number) +
                                 " of the log is not an edge of the mesh");
    }

    Mesh mesh;
    std::vector<std::uint32_t> first, last; ///< per vertex, of its list; corners of triangles gone stay in it
    std::vector<std::uint32_t> next;        ///< per corner
    std::vector<bool> vertex_gone, triangle_gone;
};

} // namespace

Mesh collapsed(const Mesh& mesh, std::span<const Collapse> log, std::size_t count) {
    if (count > log.size())
        throw std::runtime_error("cannot collapse: the log has " + std::to_string(log.size()) +
                                 " steps, not " + std::to_string(count));
    const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
    if (!fits(mesh.colours.size()) || !fits(mesh.normals.size()))
        throw std::runtime_error("cannot collapse: the mesh has not one colour and normal a vertex");
    Replay replay(mesh);
    for (std::size_t k = 0; k < count; ++k) replay.apply(log[k], k);
    return replay.finish();
}

} // namespace glcast
