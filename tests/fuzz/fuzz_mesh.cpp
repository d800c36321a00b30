// Meshes. What is accepted keeps what read_levels() promises, is checked, and written as .glb in one of three
// ways by turns: that is read back.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "tests/fuzz/input.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;

namespace {

constexpr std::string_view format = GLCAST_FUZZ_FORMAT;
constexpr std::size_t small = 3000; ///< triangles: what is larger is read, and not looked at further

void require(bool holds) {
    if (!holds) std::abort();
}

void check_level(const Level& level) {
    const Mesh& mesh = level.mesh;
    require(!mesh.triangles.empty());
    for (const Triangle& t : mesh.triangles)
        for (std::uint32_t v : t) require(v < mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    require(mesh.colours.empty() || mesh.colours.size() == mesh.positions.size());
    for (const glm::vec3& c : mesh.colours)
        for (int k = 0; k < 3; ++k) require(c[k] >= 0 && c[k] <= 1);
    if (mesh.triangles.size() < small) check_mesh(mesh, CheckDepth::everything);
}

void write_and_read(const std::vector<Level>& levels) {
    static unsigned turn = 0;
    static const std::string path = "/dev/shm/glcast-fuzz-back-" + std::to_string(getpid()) + ".glb";
    constexpr Compression ways[] = {Compression::none, Compression::quantize, Compression::meshopt};
    try {
        write_levels(path, levels, {.compression = ways[turn++ % 3]});
    } catch (const std::runtime_error&) {
        return; // too fine to be quantised, …
    }
    std::vector<Level> back;
    try {
        back = read_levels(path);
    } catch (const std::runtime_error& e) {
        // Coordinates beyond a float's are no fault of the reader.
        require(std::strstr(e.what(), "finite") != nullptr);
    }
    std::filesystem::remove(path);
    if (!back.empty()) require(back[0].mesh.triangles.size() == levels[0].mesh.triangles.size());
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}
void put(std::string& bytes, std::size_t at, std::uint32_t value) {
    std::memcpy(bytes.data() + at, &value, 4);
}

/// A number of the description becomes another, or a name of it.
void change_json(std::string& json, fuzz::Dice& dice) {
    if (dice() % 3 == 0) return fuzz::mutate(json, json.size() + 64);
    static const char* words[] = {"0",
                                  "1",
                                  "2",
                                  "3",
                                  "4",
                                  "5",
                                  "6",
                                  "255",
                                  "5120",
                                  "5121",
                                  "5123",
                                  "5125",
                                  "5126",
                                  "65537",
                                  "4294967295",
                                  "18446744073709551615",
                                  "-1",
                                  "1e300",
                                  "1e99",
                                  "0.5",
                                  "null",
                                  "[]",
                                  "{}",
                                  "true",
                                  "\"MAT4\"",
                                  "\"SCALAR\"",
                                  "\"VEC3\"",
                                  "[0,0,0]",
                                  "\"data:application/octet-stream;base64,AAAA\""};
    const auto starts = [&](std::size_t at) {
        return std::isdigit(static_cast<unsigned char>(json[at])) || json[at] == '"';
    };
    if (json.empty()) return;
    std::size_t at = dice() % json.size();
    while (at < json.size() && !starts(at)) ++at;
    if (at == json.size()) return;
    std::size_t end = at + 1;
    if (json[at] == '"')
        while (end < json.size() && json[end - (end > at + 1)] != '"') ++end;
    else
        while (end < json.size() && std::isdigit(static_cast<unsigned char>(json[end]))) ++end;
    json.replace(at, end - at, words[dice() % std::size(words)]);
}

/// Lengths follow what is changed.
std::size_t mutate_glb(std::uint8_t* data, std::size_t size, std::size_t max_size, fuzz::Dice& dice) {
    const std::string all(reinterpret_cast<const char*>(data), size);
    if (size < 20 || word(all, 12) > size - 20) return LLVMFuzzerMutate(data, size, max_size);
    std::string json = all.substr(20, word(all, 12)), rest = all.substr(20 + json.size());
    if (dice() % 3 || rest.size() < 9) {
        change_json(json, dice);
        json.resize((json.size() + 3) / 4 * 4, ' ');
    } else {
        std::string bytes = rest.substr(8);
        fuzz::mutate(bytes, bytes.size() + 16);
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        rest = rest.substr(0, 8) + bytes;
        put(rest, 0, std::uint32_t(bytes.size()));
    }
    std::string file = all.substr(0, 20) + json + rest;
    put(file, 8, std::uint32_t(file.size()));
    put(file, 12, std::uint32_t(json.size()));
    return fuzz::give(file, data, size, max_size);
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    fuzz::Dice dice(seed);
    if (format != ".glb" || dice() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
    return mutate_glb(data, size, max_size, dice);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static fuzz::InputAsFile file(GLCAST_FUZZ_FORMAT);
    fuzz::on_one_thread();
    std::vector<Level> levels;
    try {
        levels = read_levels(file.put(data, size));
    } catch (const std::runtime_error&) {
        return 0;
    }
    require(!levels.empty());
    for (const Level& level : levels) check_level(level);
    if (levels[0].mesh.triangles.size() < small) write_and_read(levels);
    return 0;
}
