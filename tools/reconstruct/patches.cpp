// Why the mesh is two-manifold. In a cell each sign-changing edge lies on two faces and is an end of one arc
// on each, so the arcs of a cell form cycles: these are the patches. Both cells of a face use the same arcs,
// and a lattice edge has four cells, so cycles (one vertex each), arcs (one mesh edge each) and lattice edges
// (one quad each) form a closed surface: the dual of a marching-cubes surface. It is a proper mesh unless two
// of its edges join the same two vertices. Vertices of two cells are joined only through their common face,
// and that has two arcs only if it is ambiguous; so this happens exactly when both arcs are in one patch on
// both sides (Schaefer, Ju and Warren 2007 and Nielson 2004 meet the same case). There the face is flipped:
// exchanging two arcs of one cycle splits it. No configuration has two such faces (checked below), so flips
// do not meet in a cell and undo nothing. The diagonal of a quad joins two cells that share only that lattice
// edge, so it is new as well.
#include "tools/reconstruct/patches.h"

#include <numeric>
#include <stdexcept>

namespace glcast {
namespace {

struct Arcs {
    int count = 0;
    int ends[2][2]; ///< edges of the cell
};

int edge_between(int c, int d) {
    for (int e = 0; e < 12; ++e) {
        const int low = edge_corner(e), high = low | 1 << edge_axis(e);
        if ((low == c && high == d) || (low == d && high == c)) return e;
    }
    throw std::logic_error("corners that share no edge");
}

Arcs arcs_of(int config, int face, bool join_filled) {
    const int a = face >> 1, b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2, base = (face & 1) << a;
    const int corner[4] = {base, base | 1 << b, base | 1 << b | 1 << c, base | 1 << c};
    int edge[4], changing[4], changes = 0;
    for (int i = 0; i < 4; ++i) {
        edge[i] = edge_between(corner[i], corner[(i + 1) % 4]);
        if ((config >> corner[i] & 1) != (config >> corner[(i + 1) % 4] & 1)) changing[changes++] = i;
    }
    Arcs arcs;
    if (changes == 2) arcs = {1, {{edge[changing[0]], edge[changing[1]]}}};
    if (changes == 4)
        for (int i = 0; i < 4; ++i)
            if ((config >> corner[i] & 1) != int(join_filled)) {
                arcs.ends[arcs.count][0] = edge[(i + 3) % 4];
                arcs.ends[arcs.count++][1] = edge[i];
            }
    return arcs;
}

void point_to_patches(PatchTable& table, int config, int flipped) {
    glm::vec3* towards = table.towards[config][flipped];
    int edges[4] = {};
    for (int k = 0; k < 4; ++k) towards[k] = glm::vec3(0);
    for (int e = 0; e < 12; ++e) {
        const int patch = table.patch[config][flipped][e];
        if (patch == 255) continue;
        ++edges[patch];
        for (int axis = 0; axis < 3; ++axis)
            if (axis != edge_axis(e)) towards[patch][axis] += (edge_corner(e) >> axis & 1) ? 0.5f : -0.5f;
    }
    for (int k = 0; k < table.count[config][flipped]; ++k) towards[k] /= float(edges[k]);
}

void number_patches(PatchTable& table, int config, int flipped) {
    std::array<int, 12> parent;
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int e) {
        while (parent[e] != e) e = parent[e];
        return e;
    };
    std::array<bool, 12> changing{};
    for (int face = 0; face < 6; ++face) {
        const Arcs arcs = arcs_of(config, face, face != flipped);
        for (int i = 0; i < arcs.count; ++i) {
            changing[arcs.ends[i][0]] = changing[arcs.ends[i][1]] = true;
            parent[root(arcs.ends[i][0])] = root(arcs.ends[i][1]);
        }
    }
    std::array<int, 12> number;
    number.fill(-1);
    int count = 0;
    for (int e = 0; e < 12; ++e) {
        if (changing[e] && number[root(e)] < 0) number[root(e)] = count++;
        table.patch[config][flipped][e] = changing[e] ? std::uint8_t(number[root(e)]) : 255;
    }
    table.count[config][flipped] = std::uint8_t(count);
    point_to_patches(table, config, flipped);
}

PatchTable make_table() {
    PatchTable table;
    for (int config = 0; config < 256; ++config) {
        for (int flipped = 0; flipped <= no_face; ++flipped) number_patches(table, config, flipped);
        table.twice[config] = no_face;
        for (int face = 0; face < 6; ++face) {
            const Arcs arcs = arcs_of(config, face, true);
            const auto& patch = table.patch[config][no_face];
            if (arcs.count < 2 || patch[arcs.ends[0][0]] != patch[arcs.ends[1][0]]) continue;
            if (table.twice[config] != no_face) throw std::logic_error("two faces meet one patch twice");
            table.twice[config] = std::uint8_t(face);
        }
    }
    return table;
}

} // namespace

const PatchTable& patch_table() {
    static const PatchTable table = make_table();
    return table;
}

} // namespace glcast
