#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "tools/progressive/packing.h"
#include "tools/progressive/split_block.h"
#include "tools/progressive/stream.h"
#include "tools/progressive/stream_layout.h"

namespace glcast {
namespace progressive {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

/// Exactly so many bytes, or fewer where the stream ends. A length that is not true costs no memory.
std::string take(std::istream& in, std::uint64_t count) {
    constexpr std::uint64_t piece = 1u << 20;
    std::string bytes;
    while (bytes.size() < count && in) {
        const std::size_t before = bytes.size();
        bytes.resize(before + std::size_t(std::min(count - before, piece)));
        in.read(bytes.data() + before, std::streamsize(bytes.size() - before));
        bytes.resize(before + std::size_t(in.gcount()));
    }
    if (in.bad()) refuse("the file cannot be read");
    return bytes;
}

/// Little-endian numbers, one after the other.
class Fields {
  public:
    explicit Fields(std::string_view bytes) : rest(bytes) {}
    template <class T> T number() {
        T value = 0;
        for (std::size_t k = 0; k < sizeof value; ++k) value = T(value | T(std::uint8_t(rest[k])) << 8 * k);
        rest.remove_prefix(sizeof value);
        return value;
    }

  private:
    std::string_view rest;
};

struct Chunk {
    std::uint32_t count = 0;
    std::string bytes; ///< unpacked
};

/// Empty where the stream is cut off. Only sizes that `allowed` agrees to are unpacked.
template <class Allowed> std::optional<Chunk> read_chunk(std::istream& in, Allowed&& allowed) {
    const std::string head = take(in, chunk_header_bytes);
    if (head.size() < chunk_header_bytes) return {};
    Fields fields(head);
    Chunk chunk{fields.number<std::uint32_t>(), {}};
    const auto size = fields.number<std::uint64_t>(), packed_size = fields.number<std::uint64_t>();
    const auto sum = fields.number<std::uint32_t>(), head_sum = fields.number<std::uint32_t>();
    if (head_sum != checksum(std::string_view(head).substr(0, chunk_header_bytes - 4)))
        refuse("the file is damaged: the head of a block has another checksum");
    if (!allowed(chunk.count, size)) refuse("the file is damaged: a block has an impossible size");
    const std::string data = take(in, packed_size);
    if (data.size() < packed_size) return {};
    if (sum != checksum(data)) refuse("the file is damaged: a block has another checksum");
    try {
        chunk.bytes = unpacked(data, size);
    } catch (const std::runtime_error& e) {
        refuse(std::string("the file is damaged: a block is not packed as it should be: ") + e.what());
    }
    return chunk;
}

struct Header {
    ProgressiveInfo info;
    std::uint16_t flags = 0;
};

Header read_header(std::istream& in) {
    std::string bytes = take(in, header_bytes);
    if (!std::string_view(bytes).starts_with(std::string_view(magic, std::min(bytes.size(), sizeof magic))) ||
        bytes.empty())
        refuse("is no progressive mesh of glcast (.glpm)");
    if (bytes.size() < header_bytes) refuse("is cut off before its base mesh: there is nothing to show");
    Fields fields(std::string_view(bytes).substr(sizeof magic));
    const auto its_version = fields.number<std::uint16_t>();
    Header header;
    header.flags = fields.number<std::uint16_t>();
    ProgressiveInfo& info = header.info;
    for (std::size_t* count : {&info.vertices, &info.triangles, &info.base_vertices, &info.base_triangles})
        *count = fields.number<std::uint32_t>();
    info.sample = std::bit_cast<double>(fields.number<std::uint64_t>());
    const auto name_bytes = fields.number<std::uint16_t>();
    if (its_version == 0 || its_version > version)
        refuse("is of format " + std::to_string(its_version) + "; this glcast reads up to " +
               std::to_string(version));
    info.name = take(in, name_bytes);
    const std::string sum = take(in, 4);
    if (sum.size() < 4) refuse("is cut off before its base mesh: there is nothing to show");
    if (Fields(sum).number<std::uint32_t>() != checksum(bytes + info.name))
        refuse("the file is damaged: its head has another checksum");
    if (info.base_vertices > info.vertices || info.base_triangles > info.triangles ||
        header.flags > (with_colours | with_normals) || !std::isfinite(info.sample) || info.sample < 0)
        refuse("the file is damaged: its head contradicts itself");
    return header;
}

/// Indices that grow, less than `end`, from the steps between them.
std::vector<std::uint32_t> growing(std::vector<std::uint32_t> steps, std::uint64_t end) {
    std::uint64_t next = 0;
    for (std::uint32_t& step : steps) {
        next += step;
        if (next >= end) refuse("the file is damaged: its base mesh is outside the original");
        step = std::uint32_t(next++);
    }
    return steps;
}

template <class Float, class Vector>
std::vector<Vector> read_vectors(ColumnReader& reader, std::size_t count) {
    std::vector<Vector> vectors(count);
    for (int k = 0; k < 3; ++k) {
        const auto column = reader.planes<Bits<Float>>(count);
        Float last = 0;
        for (std::size_t v = 0; v < count; ++v) {
            vectors[v][k] = last = with_difference<Float>(column[v], last);
            if (!std::isfinite(last))
                refuse("the file is damaged: a position, colour or normal is not finite");
        }
    }
    return vectors;
}

ProgressiveMesh read_base(std::string_view bytes, const Header& header) {
    const ProgressiveInfo& info = header.info;
    ColumnReader reader(bytes);
    auto vertex_ids = growing(reader.planes<std::uint32_t>(info.base_vertices), info.vertices);
    auto triangle_ids = growing(reader.planes<std::uint32_t>(info.base_triangles), info.triangles);
    Mesh base;
    base.triangles.resize(info.base_triangles);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto column = reader.planes<std::uint32_t>(info.base_triangles);
        std::uint32_t last = 0;
        for (std::size_t t = 0; t < column.size(); ++t) {
            base.triangles[t][k] = last += unzigzag(column[t]);
            if (last >= info.base_vertices)
                refuse("the file is damaged: a triangle has a corner that is not there");
        }
    }
    base.positions = read_vectors<double, glm::dvec3>(reader, info.base_vertices);
    if (header.flags & with_colours)
        base.colours = read_vectors<float, glm::vec3>(reader, info.base_vertices);
    if (header.flags & with_normals)
        base.normals = read_vectors<float, glm::vec3>(reader, info.base_vertices);
    return {std::move(base), std::move(vertex_ids), std::move(triangle_ids)};
}

ProgressiveMesh read_base(std::istream& in, const Header& header) {
    const std::uint64_t size =
        base_bytes(header.info.base_vertices, header.info.base_triangles, header.flags);
    const auto chunk =
        read_chunk(in, [&](std::uint32_t count, std::uint64_t bytes) { return count == 0 && bytes == size; });
    if (!chunk) refuse("is cut off before its base mesh: there is nothing to show");
    return read_base(chunk->bytes, header);
}

} // namespace
} // namespace progressive

struct ProgressiveReader::State {
    std::istream& in;
    progressive::Header header;
    ProgressiveMesh mesh;
    progressive::Incidence incidence;

    explicit State(std::istream& stream)
        : in(stream), header(progressive::read_header(in)), mesh(progressive::read_base(in, header)),
          incidence(progressive::incidence_of(mesh)) {}
};

ProgressiveReader::ProgressiveReader(std::istream& in) : state(std::make_unique<State>(in)) {
    const ProgressiveInfo& info = state->header.info;
    if (complete() && info.base_triangles != info.triangles)
        progressive::refuse("the file is damaged: it has fewer triangles than it says");
}
ProgressiveReader::~ProgressiveReader() = default;

const ProgressiveInfo& ProgressiveReader::info() const { return state->header.info; }
ProgressiveMesh& ProgressiveReader::mesh() { return state->mesh; }
const ProgressiveMesh& ProgressiveReader::mesh() const { return state->mesh; }

bool ProgressiveReader::next() {
    if (complete()) return false;
    ProgressiveMesh& mesh = state->mesh;
    mesh.refine_to(mesh.splits());
    const std::size_t left = info().splits() - mesh.splits();
    const auto chunk = progressive::read_chunk(state->in, [&](std::uint32_t count, std::uint64_t bytes) {
        return count >= 1 && count <= std::min(left, progressive::most_splits_in_block) &&
               bytes <= progressive::most_bytes_in_block;
    });
    if (!chunk) return false;
    try {
        progressive::decode_splits(chunk->bytes, chunk->count, {info().vertices, info().triangles}, mesh,
                                   state->incidence);
    } catch (const std::runtime_error& e) {
        progressive::refuse(std::string("the file is damaged: ") + e.what());
    }
    if (complete() && mesh.triangles(mesh.level()) != info().triangles)
        progressive::refuse("the file is damaged: it has fewer triangles than it says");
    return true;
}

ProgressiveFile read_progressive(const std::filesystem::path& path) {
    try {
        std::error_code code;
        if (std::filesystem::is_directory(path, code)) progressive::refuse("is a folder");
        std::ifstream in(path, std::ios::binary);
        if (!in) progressive::refuse(std::strerror(errno));
        ProgressiveReader reader(in);
        std::size_t blocks = 0;
        while (reader.next()) ++blocks;
        reader.mesh().shrink();
        const bool complete = reader.complete();
        return {reader.info(), std::move(reader.mesh()), blocks, complete};
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot read progressive mesh '" + path.string() + "': " + e.what());
    }
}

bool looks_like_progressive(const std::filesystem::path& path) {
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) return false; // a FIFO would make us wait
    std::ifstream in(path, std::ios::binary);
    char start[sizeof progressive::magic] = {};
    return in.read(start, sizeof start) && std::memcmp(start, progressive::magic, sizeof start) == 0;
}

} // namespace glcast
