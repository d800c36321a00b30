// The oracle itself: it must find every fault, or its agreement says nothing.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <unistd.h>

#include "tests/mesh/bodies.h"
#include "tests/mesh/independent_check/oracle.h"
#include "tools/mesh/check.h"

namespace glcast::test {
namespace {

struct Fault {
    const char* name;
    Mesh (*make)();
};

Mesh pinched() { // two spheres that share one vertex
    Mesh mesh = joined(sphere(1, 1), sphere(1, 1, {3, 0, 0}));
    const std::uint32_t shared = mesh.triangles[0][0], second = std::uint32_t(mesh.positions.size() / 2);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t)
            if (v == second) v = shared;
    mesh.positions.erase(mesh.positions.begin() + second);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t) v -= v > second;
    return mesh;
}

const Fault faults[] = {
    {"a hole",
     [] {
         Mesh m = sphere(1, 2);
         m.triangles.pop_back();
         return m;
     }},
    {"a triangle the wrong way round",
     [] {
         Mesh m = sphere(1, 2);
         std::swap(m.triangles[7][0], m.triangles[7][1]);
         return m;
     }},
    {"a triangle twice",
     [] {
         Mesh m = sphere(1, 2);
         m.triangles.push_back(m.triangles[7]);
         return m;
     }},
    {"a fin",
     [] {
         Mesh m = sphere(1, 2);
         m.positions.emplace_back(2, 2, 2);
         m.triangles.push_back({m.triangles[0][0], m.triangles[0][1], std::uint32_t(m.positions.size() - 1)});
         return m;
     }},
    {"a pinched vertex", pinched},
    {"cells that touch in an edge", [] { return blocks(2, 2, 1, [](int x, int y, int) { return x == y; }); }},
    {"two triangles back to back",
     [] {
         Mesh m;
         m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
         m.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}};
         return m;
     }},
    {"nothing", [] { return Mesh{}; }},
};

std::filesystem::path write_off(const Mesh& mesh) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("glcast_oracle_" + std::to_string(getpid()) + ".off");
    std::ofstream out(path);
    out << "OFF\n" << mesh.positions.size() << " " << mesh.triangles.size() << " 0\n";
    for (const glm::dvec3& p : mesh.positions) out << p.x << " " << p.y << " " << p.z << "\n";
    for (const Triangle& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    return path;
}

TEST(Oracle, FindsEveryFault) {
    for (const Fault& fault : faults) {
        const Mesh mesh = fault.make();
        EXPECT_NE(ask_oracle(mesh).fault, "") << fault.name;
        EXPECT_FALSE(check_mesh(mesh).closed_manifold()) << fault.name;
        const std::filesystem::path file = write_off(mesh);
        EXPECT_NE(ask_oracle(file).fault, "") << fault.name << ", from a file";
        std::filesystem::remove(file);
    }
}

TEST(Oracle, AgreesOnGoodBodies) {
    for (const NamedBody& body : bodies()) {
        EXPECT_EQ(ask_oracle(body.mesh).fault, "") << body.name;
        const MeshCheck check = check_mesh(body.mesh);
        EXPECT_TRUE(check.closed_manifold()) << body.name;
        EXPECT_EQ(check.euler, body.euler) << body.name;
        EXPECT_EQ(check.components, body.components) << body.name;
        const std::filesystem::path file = write_off(body.mesh);
        const OracleOpinion opinion = ask_oracle(file);
        EXPECT_EQ(opinion.fault, "") << body.name << ", from a file";
        EXPECT_EQ(opinion.triangles, body.mesh.triangles.size());
        std::filesystem::remove(file);
    }
}

TEST(Oracle, RefusesWhatIsNoFile) {
    EXPECT_NE(ask_oracle(std::filesystem::path("/nonexistent.off")).fault, "");
}

} // namespace
} // namespace glcast::test
