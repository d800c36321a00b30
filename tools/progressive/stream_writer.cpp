#include <algorithm>
#include <stdexcept>
#include <tbb/parallel_for.h>

#include "tools/progressive/packing.h"
#include "tools/progressive/split_block.h"
#include "tools/progressive/stream.h"
#include "tools/progressive/stream_layout.h"

namespace glcast {
namespace progressive {
namespace {

/// Blocks are small at first and grow with the mesh: wherever a stream is cut off, it holds most of what came
/// in.
std::size_t splits_of_next_block(const ProgressiveMesh& mesh) {
    const std::size_t left = mesh.splits() - mesh.level();
    return std::min(left, std::clamp<std::size_t>(mesh.vertices(mesh.level()) / 4, 256, 16384));
}

template <class T> void put(std::string& bytes, T value) { // little-endian
    if constexpr (std::is_same_v<T, double>)
        put(bytes, std::bit_cast<std::uint64_t>(value));
    else
        for (std::size_t k = 0; k < sizeof value; ++k) bytes.push_back(char(std::uint8_t(value >> 8 * k)));
}

void append(OutputFile& file, const std::string& bytes) {
    if (!file.append(bytes.data(), bytes.size())) throw std::runtime_error(file.error());
}

std::uint16_t flags_of(const ProgressiveMesh& mesh) {
    return std::uint16_t((mesh.has_colours() ? with_colours : 0) | (mesh.has_normals() ? with_normals : 0));
}

std::string header(const ProgressiveMesh& mesh, const ProgressiveInfo& info) {
    if (info.name.size() > UINT16_MAX)
        throw std::runtime_error("a name of more than 65,535 bytes cannot be written");
    std::string bytes(magic, sizeof magic);
    put(bytes, version), put(bytes, flags_of(mesh));
    for (const std::size_t count :
         {mesh.vertices(mesh.splits()), mesh.triangles(mesh.splits()), mesh.vertices(0), mesh.triangles(0)})
        put(bytes, std::uint32_t(count));
    put(bytes, info.sample);
    put(bytes, std::uint16_t(info.name.size()));
    bytes += info.name;
    put(bytes, checksum(bytes));
    return bytes;
}

/// At the base level.
Planes base_mesh(const ProgressiveMesh& mesh) {
    Planes planes;
    const auto vertices = std::uint32_t(mesh.vertices(0)), triangles = std::uint32_t(mesh.triangles(0));
    std::vector<std::uint32_t> column;
    for (std::uint32_t v = 0; v < vertices; ++v)
        column.push_back(mesh.vertex_id(v) - (v ? mesh.vertex_id(v - 1) + 1 : 0));
    put_planes(planes, column);
    column.clear();
    for (std::uint32_t t = 0; t < triangles; ++t)
        column.push_back(mesh.triangle_id(t) - (t ? mesh.triangle_id(t - 1) + 1 : 0));
    put_planes(planes, column);
    for (std::size_t k = 0; k < 3; ++k) {
        column.clear();
        for (std::uint32_t t = 0; t < triangles; ++t)
            column.push_back(zigzag(mesh.triangle(t)[k] - (t ? mesh.triangle(t - 1)[k] : 0)));
        put_planes(planes, column);
    }
    const auto put_vectors = [&](auto zero, auto value) {
        using Float = decltype(zero);
        for (int k = 0; k < 3; ++k) {
            std::vector<Bits<Float>> differences;
            for (std::uint32_t v = 0; v < vertices; ++v)
                differences.push_back(difference<Float>(value(v)[k], v ? value(v - 1)[k] : zero));
            put_planes(planes, differences);
        }
    };
    put_vectors(0.0, [&](std::uint32_t v) { return mesh.vertex(v).position; });
    if (mesh.has_colours()) put_vectors(0.0f, [&](std::uint32_t v) { return mesh.vertex(v).colour; });
    if (mesh.has_normals()) put_vectors(0.0f, [&](std::uint32_t v) { return mesh.vertex(v).normal; });
    return planes;
}

struct Chunk {
    std::size_t count = 0; ///< of splits
    Planes planes;
};

/// With the header in front.
std::string finished(const Chunk& chunk) {
    const std::string data = packed(chunk.planes);
    std::string bytes;
    put(bytes, std::uint32_t(chunk.count));
    put(bytes, std::uint64_t(chunk.planes.bytes.size())), put(bytes, std::uint64_t(data.size()));
    put(bytes, checksum(data));
    put(bytes, checksum(bytes));
    return bytes + data;
}

void write_splits(OutputFile& file, ProgressiveMesh& mesh) {
    constexpr std::size_t at_once = 16; // blocks in memory
    Incidence incidence = incidence_of(mesh);
    while (mesh.level() < mesh.splits()) {
        std::vector<Chunk> chunks;
        while (mesh.level() < mesh.splits() && chunks.size() < at_once) {
            Chunk& chunk = chunks.emplace_back();
            chunk.count = splits_of_next_block(mesh);
            chunk.planes = encode_splits(mesh, incidence, chunk.count);
        }
        std::vector<std::string> done(chunks.size());
        tbb::parallel_for(std::size_t(0), chunks.size(),
                          [&](std::size_t k) { done[k] = finished(chunks[k]); });
        for (const std::string& bytes : done) append(file, bytes);
    }
}

} // namespace
} // namespace progressive

void write_progressive(OutputFile& file, ProgressiveMesh& mesh, const ProgressiveInfo& info) {
    using namespace progressive;
    const std::size_t level = mesh.level();
    mesh.refine_to(0);
    append(file, header(mesh, info));
    append(file, finished({0, base_mesh(mesh)}));
    write_splits(file, mesh);
    mesh.refine_to(level);
}

} // namespace glcast
