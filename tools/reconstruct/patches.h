// The surface patches of a cell: which of its twelve edges belong to one vertex.
//
// A cell is the cube between 8 samples. Corner c sits at (c & 1, c >> 1 & 1, c >> 2); edge 4 a + k runs along
// axis a, k counting the corners without bit a upwards; face 2 a + s is the one at coordinate s of axis a. A
// face whose corners alternate is ambiguous: the surface crosses it in two arcs. They are drawn around the
// empty corners, which joins the filled ones (a sheet of samples must hold together), and around the filled
// ones where the face is `flipped`.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace glcast {

inline constexpr int no_face = 6;

struct PatchTable {
    /// Number of patches of a configuration (bit c: corner c is filled) with one flipped face, or no_face.
    std::uint8_t count[256][7];
    /// Patch of each edge, 255 where the edge does not change sign.
    std::uint8_t patch[256][7][12];
    /// The ambiguous face both of whose arcs are in one patch: never more than one (asserted); else no_face.
    std::uint8_t twice[256];
    /// From the middle of the cell towards each patch: the mean of the middles of its edges. Patches of one
    /// cell that are pulled apart so far, or any part of it, do not touch (mend.cpp; asserted by a test for
    /// every configuration).
    glm::vec3 towards[256][7][4];
};

const PatchTable& patch_table();

inline constexpr int edge_axis(int edge) { return edge >> 2; }
/// Corner at the lower end of an edge.
inline constexpr int edge_corner(int edge) {
    constexpr int corners[12] = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};
    return corners[edge];
}

} // namespace glcast
