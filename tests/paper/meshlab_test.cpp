// `glcast compare` against the Hausdorff filter of MeshLab, run by its own command-line program.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "fixtures/shapes.h"
#include "tests/support/xvfb.h"
#include "tools/io/mesh_io.h"

namespace glcast::paper {
namespace {

using test::run;

struct Distances {
    double mean = 0, rms = 0, max = 0;
};

constexpr int points = 1'500'000;

/// MeshLab 2020.09 makes a GL context even to measure, so it needs a display.
Distances by_meshlab(const test::TemporaryFolder& folder, const std::string& display) {
    std::ofstream(folder / "hausdorff.mlx")
        << "<!DOCTYPE FilterScript>\n<FilterScript>\n <filter name=\"Hausdorff Distance\">\n"
           "  <Param type=\"RichMesh\" name=\"SampledMesh\" value=\"0\"/>\n"
           "  <Param type=\"RichMesh\" name=\"TargetMesh\" value=\"1\"/>\n"
           "  <Param type=\"RichBool\" name=\"SaveSample\" value=\"false\"/>\n"
           "  <Param type=\"RichBool\" name=\"SampleVert\" value=\"true\"/>\n"
           "  <Param type=\"RichBool\" name=\"SampleEdge\" value=\"false\"/>\n"
           "  <Param type=\"RichBool\" name=\"SampleFauxEdge\" value=\"false\"/>\n"
           "  <Param type=\"RichBool\" name=\"SampleFace\" value=\"true\"/>\n"
           "  <Param type=\"RichInt\" name=\"SampleNum\" value=\""
        << points
        << "\"/>\n  <Param type=\"RichAbsPerc\" name=\"MaxDist\" value=\"200\" min=\"0\" max=\"1000\"/>\n"
           " </filter>\n</FilterScript>\n";
    const test::Outcome ran = run({.arguments = {"meshlabserver", "-i", folder / "a.ply", folder / "b.ply",
                                                 "-s", folder / "hausdorff.mlx"},
                                   .environment = {{"DISPLAY", display}, {"LC_ALL", "C"}},
                                   .timeout_seconds = 90});
    const std::regex line(R"(max (\d+\.\d+)\s+mean : (\d+\.\d+)\s+RMS : (\d+\.\d+))");
    std::smatch found;
    const std::string text = ran.out + ran.err;
    if (!std::regex_search(text, found, line)) {
        ADD_FAILURE() << "meshlabserver said no distance: " << text;
        return {};
    }
    return {std::stod(found[2]), std::stod(found[3]), std::stod(found[1])};
}

Distances by_glcast(const test::TemporaryFolder& folder) {
    const test::Outcome ran =
        run({.arguments = {GLCAST, "compare", folder / "a.ply", folder / "b.ply", "--all-points", "--points",
                           std::to_string(points), "--json"},
             .environment = {}});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto units = nlohmann::json::parse(ran.out).at("aToB").at("units");
    return {units.at("mean"), units.at("rms"), units.at("max")};
}

class MeshLab : public testing::TestWithParam<std::string> {};

/// A shape and a worse one, 1000 times as large: MeshLab prints six decimals.
TEST_P(MeshLab, AgreesWithinOnePerCent) {
    Level original, coarse;
    original.mesh = fixtures::truth(GetParam(), 1);
    original.mesh.normals.clear();
    original.mesh.colours.clear();
    for (glm::dvec3& p : original.mesh.positions) p *= 1000.0;
    coarse.mesh = original.mesh;
    std::size_t kept = 0; // every vertex on a lattice: steps, folds, holes
    for (glm::dvec3& p : coarse.mesh.positions) p = glm::round(p / 57.3 + 0.37) * 57.3;
    for (const Triangle& t : original.mesh.triangles) {
        const auto& p = coarse.mesh.positions;
        if (p[t[0]] != p[t[1]] && p[t[1]] != p[t[2]] && p[t[2]] != p[t[0]]) coarse.mesh.triangles[kept++] = t;
    }
    coarse.mesh.triangles.resize(kept);
    const test::TemporaryFolder folder;
    write_levels(folder / "a.ply", {&original, 1});
    write_levels(folder / "b.ply", {&coarse, 1});
    const test::Xvfb screen;
    const Distances theirs = by_meshlab(folder, screen.display()), ours = by_glcast(folder);
    std::printf("%s: mean %.4f and %.4f, RMS %.4f and %.4f, maximum %.4f and %.4f (MeshLab's first)\n",
                GetParam().c_str(), theirs.mean, ours.mean, theirs.rms, ours.rms, theirs.max, ours.max);
    EXPECT_GT(theirs.mean, 1);
    EXPECT_NEAR(ours.mean, theirs.mean, 0.01 * theirs.mean);
    EXPECT_NEAR(ours.rms, theirs.rms, 0.01 * theirs.rms);
    EXPECT_NEAR(ours.max, theirs.max, 0.01 * theirs.max);
}

INSTANTIATE_TEST_SUITE_P(Pairs, MeshLab, testing::Values("teapot", "spheres", "torus"),
                         [](const auto& info) { return info.param; });

} // namespace
} // namespace glcast::paper
