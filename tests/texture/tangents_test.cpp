// Tangents against MikkTSpace itself, as three.js has it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <unistd.h>

#include "tests/texture/baked.h"
#include "tools/texture/bake.h"

namespace glcast::test {
namespace {

/// Three corners a triangle, in single precision as in a file.
template <class Value> void append(std::vector<float>& out, const Value& value, int count) {
    for (int k = 0; k < count; ++k) out.push_back(float(value[k]));
}

std::vector<glm::vec4> mikktspace(const Mesh& mesh, const Texture& texture) {
    std::vector<float> all;
    for (const Triangle& t : mesh.triangles)
        for (std::uint32_t v : t) append(all, mesh.positions[v], 3);
    for (const Triangle& t : mesh.triangles)
        for (std::uint32_t v : t) append(all, mesh.normals[v], 3);
    for (const auto& corners : texture.coordinates)
        for (const glm::vec2& p : corners) append(all, p, 2);
    const auto folder =
        std::filesystem::temp_directory_path() / ("glcast-tangents-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "in", std::ios::binary)
        .write(reinterpret_cast<const char*>(all.data()), std::streamsize(all.size() * 4));
    const std::string command = std::string(GLCAST_NODE " " GLCAST_TANGENTS " " GLCAST_NODE_MODULES " ") +
                                (folder / "in").string() + " " + (folder / "out").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::vector<glm::vec4> out(mesh.triangles.size() * 3);
    std::ifstream in(folder / "out", std::ios::binary);
    in.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size() * sizeof(glm::vec4)));
    EXPECT_EQ(std::size_t(in.gcount()), out.size() * sizeof(glm::vec4));
    std::filesystem::remove_all(folder);
    return out;
}

void expect_mikktspace(const Source& source, double triangles) {
    Mesh mesh = coarse(source.full, triangles);
    const Texture texture = bake_texture(mesh, source.captured, {.size = 512});
    const auto wanted = mikktspace(mesh, texture);
    double worst = 0;
    std::size_t other_side = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const glm::vec4& own = texture.tangents[i / 3][i % 3];
        worst = std::max(worst, degrees_between(glm::vec3(own), glm::vec3(wanted[i])));
        other_side += own.w != wanted[i].w;
    }
    EXPECT_LT(worst, 0.1) << triangles;
    EXPECT_EQ(other_side, 0u) << triangles;
}

TEST(Tangents, AreThoseOfMikkTSpace) {
    const Source ring = make_source(cast_body(*torus({0, 0, 0}, {1, 2, 3}, 0.6, 0.25), test_box, 64));
    const Source block =
        make_source(cast_body(*box({0, 0, 0}, {0.6, 0.5, 0.4}, turned({1, 2, 3}, 12)), test_box, 64));
    for (const double triangles : {200.0, 5000.0, 1e9})
        for (const Source* source : {&ring, &block}) expect_mikktspace(*source, triangles);
}

} // namespace
} // namespace glcast::test
