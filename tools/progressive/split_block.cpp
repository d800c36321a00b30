#include "tools/progressive/split_block.h"

#include <cmath>
namespace glcast::progressive {
namespace {

using Vertex = ProgressiveMesh::Vertex;

constexpr std::uint16_t not_around = 0xFFFF; ///< an apex that is no neighbour of the vertex that is split
constexpr std::size_t enough_mask_bytes = 1u << 20;

/// Three components of a vector of one kind, for every split.
template <class Float> using Columns = std::array<std::vector<Bits<Float>>, 3>;

/// What a block holds, each kind of number by itself. "fine": of the vertex that is split, after the split.
struct Block {
    std::vector<std::uint32_t> kept, vertex_id; ///< a split
    std::vector<std::uint8_t> triangles;        ///< a split: how many it brings
    std::vector<std::uint8_t> form;  ///< a triangle: corner of kept, + 3 where the new vertex comes after it
    std::vector<std::uint16_t> apex; ///< a triangle: 2 · place in the ring + 1 for the corner before kept
    std::vector<std::uint32_t> triangle_id; ///< a triangle
    std::vector<std::uint32_t> far_apex;    ///< those of not_around
    Columns<double> fine_position, new_position;
    Columns<float> fine_colour, new_colour, fine_normal, new_normal;
    std::string moved; ///< a split: a bit for each triangle of the ring, the lowest first; whole bytes
};

/// Without a product, which compilers for some processors would fuse with the sum and round otherwise.
template <class Vector> Vector mirrored(const Vector& fine, const Vector& coarse) {
    return (coarse - fine) + coarse;
}

template <class Float, class Vector>
void put_vectors(Columns<Float>& fine_columns, Columns<Float>& new_columns, const Vector& coarse,
                 const Vector& fine, const Vector& added, const Vector& expected) {
    for (std::size_t k = 0; k < 3; ++k) {
        fine_columns[k].push_back(difference<Float>(fine[int(k)], coarse[int(k)]));
        new_columns[k].push_back(difference<Float>(added[int(k)], expected[int(k)]));
    }
}

void put_vertices(Block& block, const Vertex& coarse, const Vertex& fine, const Vertex& added) {
    put_vectors<double>(block.fine_position, block.new_position, coarse.position, fine.position,
                        added.position, mirrored(fine.position, coarse.position));
    put_vectors<float>(block.fine_colour, block.new_colour, coarse.colour, fine.colour, added.colour,
                       coarse.colour);
    put_vectors<float>(block.fine_normal, block.new_normal, coarse.normal, fine.normal, added.normal,
                       coarse.normal);
}

/// Which place in the ring names the vertex, or not_around.
std::uint16_t place_of(std::uint32_t vertex, const std::vector<std::uint32_t>& ring,
                       const ProgressiveMesh& mesh) {
    for (std::size_t k = 0; k < ring.size() && 2 * k + 1 < not_around; ++k)
        for (std::uint32_t side = 0; side < 2; ++side)
            if (mesh.triangle(ring[k] / 3)[(ring[k] + 1 + side - ring[k] / 3 * 3) % 3] == vertex)
                return std::uint16_t(2 * k + side);
    return not_around;
}

void put_triangle(Block& block, std::uint32_t number, std::uint32_t kept, std::uint32_t added,
                  const std::vector<std::uint32_t>& ring, const ProgressiveMesh& mesh) {
    const Triangle& corners = mesh.triangle(number);
    std::size_t at = 0;
    while (corners[at] != kept) ++at;
    const bool added_is_next = corners[(at + 1) % 3] == added;
    const std::uint32_t apex = corners[(at + (added_is_next ? 2 : 1)) % 3];
    const std::uint16_t place = place_of(apex, ring, mesh);
    block.form.push_back(std::uint8_t(at + (added_is_next ? 3 : 0)));
    block.apex.push_back(place);
    if (place == not_around) block.far_apex.push_back(apex);
    const std::uint32_t expected = place == not_around ? 0 : mesh.triangle_id(ring[place / 2] / 3);
    block.triangle_id.push_back(zigzag(mesh.triangle_id(number) - expected));
}

void put_split(Block& block, ProgressiveMesh& mesh, Incidence& incidence) {
    const std::size_t split = mesh.level();
    const std::uint32_t kept = mesh.kept_of(split);
    const auto added = std::uint32_t(mesh.vertices(split));
    block.kept.push_back(kept);
    block.vertex_id.push_back(zigzag(mesh.vertex_id(added) - mesh.vertex_id(kept)));
    block.triangles.push_back(std::uint8_t(mesh.triangles(split + 1) - mesh.triangles(split)));
    const std::vector<std::uint32_t>& ring = incidence.around(kept);
    for (std::size_t t = mesh.triangles(split); t < mesh.triangles(split + 1); ++t)
        put_triangle(block, std::uint32_t(t), kept, added, ring, mesh);
    put_vertices(block, mesh.vertex(kept), mesh.other_of(split), mesh.vertex(added));
    const std::span<const std::uint32_t> moved = mesh.moved_by(split);
    std::vector<bool> is_moved(ring.size());
    const std::size_t mask = block.moved.size();
    block.moved.resize(mask + (ring.size() + 7) / 8);
    for (std::size_t k = 0; k < ring.size(); ++k) {
        is_moved[k] = std::binary_search(moved.begin(), moved.end(), ring[k] / 3);
        if (is_moved[k]) block.moved[mask + k / 8] = char(block.moved[mask + k / 8] | 1 << k % 8);
    }
    incidence.add_vertices(1);
    incidence.move(kept, added, is_moved);
    for (std::size_t t = mesh.triangles(split); t < mesh.triangles(split + 1); ++t)
        incidence.add_triangle(mesh.triangle(std::uint32_t(t)));
    mesh.refine_to(split + 1);
}

/// Both directions go through the same list.
template <class Block, class Do> void each_vector_column(Block& block, bool colours, bool normals, Do&& act) {
    for (auto* columns : {&block.fine_position, &block.new_position})
        for (auto& column : *columns) act(column);
    if (colours)
        for (auto* columns : {&block.fine_colour, &block.new_colour})
            for (auto& column : *columns) act(column);
    if (normals)
        for (auto* columns : {&block.fine_normal, &block.new_normal})
            for (auto& column : *columns) act(column);
}

Planes planes_of(const Block& block, bool colours, bool normals) {
    Planes planes;
    put_planes(planes, block.kept);
    put_planes(planes, block.vertex_id);
    put_planes(planes, block.triangles);
    put_planes(planes, block.form);
    put_planes(planes, block.apex);
    put_planes(planes, block.triangle_id);
    put_planes(planes, block.far_apex);
    each_vector_column(block, colours, normals, [&](const auto& column) { put_planes(planes, column); });
    planes.bytes += block.moved;
    return planes;
}

/// All but the moved triangles, which are the rest of `reader`.
Block read_block(ColumnReader& reader, std::size_t count, bool colours, bool normals) {
    Block block;
    block.kept = reader.planes<std::uint32_t>(count);
    block.vertex_id = reader.planes<std::uint32_t>(count);
    block.triangles = reader.planes<std::uint8_t>(count);
    std::size_t triangles = 0;
    for (const std::uint8_t each : block.triangles) triangles += each;
    block.form = reader.planes<std::uint8_t>(triangles);
    block.apex = reader.planes<std::uint16_t>(triangles);
    block.triangle_id = reader.planes<std::uint32_t>(triangles);
    block.far_apex = reader.planes<std::uint32_t>(
        std::size_t(std::count(block.apex.begin(), block.apex.end(), not_around)));
    each_vector_column(block, colours, normals, [&](auto& column) {
        column = reader.planes<typename std::decay_t<decltype(column)>::value_type>(count);
    });
    return block;
}

[[noreturn]] void damaged(const char* why) { throw std::runtime_error(why); }

/// Reads the splits of a block one after the other into a mesh.
class SplitReader {
  public:
    SplitReader(std::string_view bytes, std::size_t count, const Totals& totals, ProgressiveMesh& mesh,
                Incidence& incidence)
        : reader(bytes), block(read_block(reader, count, mesh.has_colours(), mesh.has_normals())),
          totals(totals), mesh(mesh), incidence(incidence) {}

    void read(std::size_t k) {
        const std::size_t vertices = mesh.vertices(mesh.level());
        const auto added = std::uint32_t(vertices);
        split.kept = block.kept[k];
        if (split.kept >= vertices) damaged("a split is of a vertex that is not there");
        split.vertex_id = mesh.vertex_id(split.kept) + unzigzag(block.vertex_id[k]);
        if (split.vertex_id >= totals.vertices) damaged("a vertex is outside the original");
        const std::vector<std::uint32_t>& ring = incidence.around(split.kept);
        read_triangles(block.triangles[k], ring, added);
        read_vertices(k);
        read_moved(ring);
        incidence.add_vertices(1);
        incidence.move(split.kept, added, is_moved);
        for (const Triangle& t : split.triangles) incidence.add_triangle(t);
        mesh.append(split);
    }

    void end() const {
        if (reader.left()) damaged("a block holds more than it says");
    }

  private:
    void read_triangles(std::size_t count, const std::vector<std::uint32_t>& ring, std::uint32_t added) {
        split.triangles.clear(), split.triangle_ids.clear();
        if (count < 1 || count > 2) damaged("a split brings no triangle, or more than two");
        if (mesh.triangles(mesh.level()) + count > totals.triangles)
            damaged("there are more triangles than it says");
        for (; count > 0; --count, ++triangle) {
            const std::uint16_t place = block.apex[triangle];
            std::uint32_t apex = 0, expected = 0;
            if (place == not_around) {
                apex = block.far_apex[far++];
            } else {
                if (place / 2u >= ring.size()) damaged("a triangle is at a vertex that is not there");
                const std::uint32_t corner = ring[place / 2], t = corner / 3;
                apex = mesh.triangle(t)[(corner - 3 * t + 1 + place % 2) % 3];
                expected = mesh.triangle_id(t);
            }
            const std::uint8_t form = block.form[triangle];
            if (form > 5 || apex >= added || apex == split.kept)
                damaged("a triangle is at a vertex that is not there");
            Triangle corners{};
            corners[form % 3] = split.kept;
            corners[(form % 3 + (form < 3 ? 2 : 1)) % 3] = added;
            corners[(form % 3 + (form < 3 ? 1 : 2)) % 3] = apex;
            split.triangles.push_back(corners);
            split.triangle_ids.push_back(expected + unzigzag(block.triangle_id[triangle]));
            if (split.triangle_ids.back() >= totals.triangles) damaged("a triangle is outside the original");
        }
    }

    template <class Float, class Vector>
    static Vector vector_at(const Columns<Float>& columns, std::size_t k, const Vector& expected) {
        Vector v(0);
        for (int c = 0; c < 3; ++c) {
            v[c] = with_difference<Float>(columns[std::size_t(c)][k], expected[c]);
            if (!std::isfinite(v[c])) damaged("a position, colour or normal is not finite");
        }
        return v;
    }

    void read_vertices(std::size_t k) {
        const Vertex coarse = mesh.vertex(split.kept);
        Vertex &fine = split.kept_fine, &added = split.added;
        fine.position = vector_at<double>(block.fine_position, k, coarse.position);
        added.position = vector_at<double>(block.new_position, k, mirrored(fine.position, coarse.position));
        if (mesh.has_colours()) {
            fine.colour = vector_at<float>(block.fine_colour, k, coarse.colour);
            added.colour = vector_at<float>(block.new_colour, k, coarse.colour);
        }
        if (mesh.has_normals()) {
            fine.normal = vector_at<float>(block.fine_normal, k, coarse.normal);
            added.normal = vector_at<float>(block.new_normal, k, coarse.normal);
        }
    }

    void read_moved(const std::vector<std::uint32_t>& ring) {
        const std::string_view mask = reader.take((ring.size() + 7) / 8);
        is_moved.assign(ring.size(), false);
        split.moved.clear();
        for (std::size_t k = 0; k < ring.size(); ++k) {
            is_moved[k] = std::uint8_t(mask[k / 8]) >> k % 8 & 1;
            if (is_moved[k]) split.moved.push_back(ring[k] / 3);
        }
    }

    ColumnReader reader;
    Block block;
    Totals totals;
    ProgressiveMesh& mesh;
    Incidence& incidence;
    std::size_t triangle = 0, far = 0; ///< of the block, the next to be read
    ProgressiveMesh::Split split;      ///< kept from one to the next for its memory
    std::vector<bool> is_moved;
};

} // namespace

Incidence incidence_of(const ProgressiveMesh& mesh) {
    Incidence incidence;
    incidence.add_vertices(mesh.vertices(0));
    for (std::size_t t = 0; t < mesh.triangles(0); ++t)
        incidence.add_triangle(mesh.triangle(std::uint32_t(t)));
    return incidence;
}

Planes encode_splits(ProgressiveMesh& mesh, Incidence& incidence, std::size_t& count) {
    Block block;
    std::size_t done = 0;
    while (done < count && block.moved.size() < enough_mask_bytes) put_split(block, mesh, incidence), ++done;
    count = done;
    return planes_of(block, mesh.has_colours(), mesh.has_normals());
}

void decode_splits(std::string_view bytes, std::size_t count, const Totals& totals, ProgressiveMesh& mesh,
                   Incidence& incidence) {
    SplitReader reader(bytes, count, totals, mesh, incidence);
    for (std::size_t k = 0; k < count; ++k) reader.read(k);
    reader.end();
}

} // namespace glcast::progressive
