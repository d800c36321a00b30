#include "tools/view/packing.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <zlib.h>

namespace glcast::view {
namespace {

constexpr double steps = 65535;

/// Numbers as differences to the one before.
class Differences {
  public:
    explicit Differences(Bytes& bytes) : bytes(bytes) {}

    void number(std::int64_t value) {
        const std::int64_t step = value - last;
        last = value;
        std::uint64_t rest = (std::uint64_t(step) << 1) ^ std::uint64_t(step >> 63);
        for (; rest > 127; rest >>= 7) bytes.push_back(char(rest | 128));
        bytes.push_back(char(rest));
    }
    void byte(int value) {
        bytes.push_back(char(value - int(last)));
        last = value;
    }

  private:
    Bytes& bytes;
    std::int64_t last = 0;
};

std::int64_t rounded(double share) { return std::llround(std::clamp(share, 0.0, 1.0) * steps); }

template <class Vector> void add_bytes(Bytes& bytes, const std::vector<Vector>& values, float one) {
    for (int k = 0; k < Vector::length(); ++k) {
        Differences to(bytes);
        for (const Vector& value : values) to.byte(int(std::lround(value[k] * one)));
    }
}

} // namespace

Bytes deflated(const Bytes& bytes) {
    uLongf size = compressBound(bytes.size());
    Bytes out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), 6) != Z_OK)
        throw std::runtime_error("cannot compress: out of memory");
    out.resize(size);
    return out;
}

std::string base64(const Bytes& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return i + k < bytes.size() ? unsigned(static_cast<unsigned char>(bytes[i + k])) : 0u;
        };
        const unsigned group = at(0) << 16 | at(1) << 8 | at(2);
        for (int shift = 18; shift >= 0; shift -= 6) text.push_back(digits[group >> shift & 63]);
    }
    for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
    return text;
}

namespace {

void add_vertices(Bytes& bytes, const Mesh& mesh, std::span<const double> distance, double largest_distance,
                  const Cube& cube) {
    bytes.reserve(mesh.positions.size() * 12 + mesh.triangles.size() * 6);
    for (int k = 0; k < 3; ++k) {
        Differences to(bytes);
        for (const glm::dvec3& p : mesh.positions) to.number(rounded((p[k] - cube.lo[k]) / cube.size));
    }
    Differences to(bytes);
    for (const double d : distance) to.number(largest_distance > 0 ? rounded(d / largest_distance) : 0);
    add_bytes(bytes, mesh.normals, 127);
    add_bytes(bytes, mesh.colours, 255);
}

void add_triangles(Bytes& bytes, const Mesh& mesh) {
    Differences corners(bytes);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) corners.number(v);
}

} // namespace

Bytes packed_level(const Mesh& mesh, std::span<const double> distance, double largest_distance, const Cube& cube) {
    Bytes bytes;
    add_vertices(bytes, mesh, distance, largest_distance, cube);
    add_triangles(bytes, mesh);
    return deflated(bytes);
}

Bytes packed_level(const CutMesh& cut, double largest_distance, const Cube& cube) {
    Bytes bytes;
    add_vertices(bytes, cut.mesh, cut.distance, largest_distance, cube);
    for (int k = 0; k < 2; ++k) {
        Differences to(bytes);
        for (const glm::vec2& at : cut.coordinates) to.number(rounded(at[k]));
    }
    add_bytes(bytes, cut.tangents, 127);
    add_triangles(bytes, cut.mesh);
    return deflated(bytes);
}

} // namespace glcast::view
