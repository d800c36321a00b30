// The glcast command, run as a user runs it: exit codes, what goes where, and what is left behind.
#include <gtest/gtest.h>

#include "tests/file/command_line.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/check.h"

using namespace glcast;
using namespace glcast::samples;
using Json = nlohmann::json;

namespace {

class Command : public testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(write_sphere(file("s.exr"), 48), ""); }
    std::string file(const std::string& name) const { return (folder / name).string(); }
    Folder folder;
};

} // namespace

TEST_F(Command, MeshInfoCompareRender) {
    const Json made = json_of("mesh " + file("s.exr") + " -o " + file("s.glb"));
    EXPECT_EQ(made["n"], 48);
    ASSERT_EQ(made["levels"].size(), 4u) << "for 24, 12, 6 and 3 pixels: " << made["notes"] << made["levels"];
    double pixels = 24, limit = 0.25; // samples
    for (const Json& level : made["levels"]) {
        EXPECT_LE(level["p999ErrorSamples"], limit);
        EXPECT_EQ(level["pixels"], pixels);
        pixels /= 2, limit *= 2;
    }
    for (const Json& level : made["levels"]) {
        EXPECT_TRUE(level["closedManifold"]);
        EXPECT_EQ(level["euler"], 2);
        EXPECT_EQ(level["boundaryEdges"], 0);
    }
    EXPECT_EQ(made["files"][0]["bytes"], std::filesystem::file_size(file("s.glb")));
    EXPECT_LT(made["levels"][1]["triangles"], made["levels"][0]["triangles"]);
    EXPECT_GT(made["levels"][1]["maxError"], 0);
    EXPECT_LT(made["levels"][0]["triangles"], made["fullTriangles"].get<int>() / 10);
    EXPECT_EQ(made["files"][3]["path"], file("s_LOD3.glb"));

    const Json mesh = json_of("info " + file("s.glb"));
    EXPECT_EQ(mesh["kind"], "mesh");
    const double volume = 4.0 / 3 * M_PI * 1.2 * 1.2 * 1.2; // radius 0.4 of a box of 3
    EXPECT_NEAR(mesh["levels"][0]["volume"].get<double>(), volume, volume * 0.01);
    ASSERT_EQ(mesh["levels"].size(), 4u) << "those beside it too";
    EXPECT_EQ(mesh["levels"][3]["name"], "s_LOD3");

    ASSERT_EQ(glcast_run("mesh " + file("s.exr") + " -o " + file("s.ply")).status, 0);
    const Json same = json_of("compare " + file("s.glb") + " " + file("s.ply"));
    EXPECT_LT(same["aToB"]["samples"]["max"], 1e-3);
    EXPECT_TRUE(same["b"]["closedManifold"]);
    EXPECT_NEAR(same["sample"].get<double>(), 3.0 / 48, 1e-12) << "the .glb tells";

    const Ran drawn = glcast_run("render " + file("s.glb") + " -o " + file("s.png") + " --size 64");
    EXPECT_EQ(drawn.status, 0) << drawn.output;
    EXPECT_TRUE(read_text(file("s.png")).starts_with("\x89PNG"));
}

TEST_F(Command, ValidatorFindsNothingInACast) {
    ASSERT_EQ(glcast_run("mesh " + file("s.exr") + " -o " + file("s.glb")).status, 0);
    ASSERT_EQ(glcast_run("mesh " + file("s.exr") + " -o " + file("c.glb") + " --method cubes").status, 0);
    const Ran ran = run("node " GLCAST_VALIDATE " " + file("s.glb") + " " + file("c.glb"));
    EXPECT_EQ(ran.status, 0) << ran.output;
}

TEST_F(Command, TexturesOfEveryLevelThatIsWritten) {
    const std::string mesh = "mesh " + file("s.exr") + " --texture 128 --triangles 400,100 -o ";
    const Json glb = json_of(mesh + file("s.glb"));
    EXPECT_EQ(glb["levels"].size(), 2u) << "what was asked for and nothing else";
    for (const char* name : {"s.ply", "s.obj"}) {
        const Json json = json_of(mesh + file(name));
        ASSERT_EQ(json["levels"].size(), 2u) << name;
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_LE(json["levels"][k]["triangles"], k ? 100 : 400);
            EXPECT_EQ(json["levels"][k]["texture"], glb["levels"][k]["texture"]) << name;
        }
    }
    for (const char* name : {"s.colour.png", "s_LOD1.colour.png", "s.mtl", "s_LOD1.mtl"})
        EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
    const Ran ran = run("node " GLCAST_VALIDATE " " + file("s.glb"));
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_EQ(glcast_run("mesh " + file("s.exr") + " -o " + file("t.glb") + " --texture 100").status, 2);
    EXPECT_FALSE(std::filesystem::exists(file("t.glb")));
}

TEST_F(Command, InfoOfACapture) {
    const Json info = json_of("info " + file("s.exr"));
    EXPECT_EQ(info["kind"], "capture");
    EXPECT_EQ(info["n"], 48);
    EXPECT_EQ(info["program"], "sphere");
    EXPECT_EQ(info["notUnderstood"]["glFancy"], 3);
    ASSERT_EQ(info["parts"].size(), 6u);
    EXPECT_NEAR(info["parts"][0]["coverage"].get<double>(), M_PI * 0.4 * 0.4, 0.01);
    EXPECT_NE(glcast_run("info " + file("s.exr")).output.find("+z.0"), std::string::npos);
}

TEST_F(Command, TargetsAreKept) {
    const Json made = json_of("mesh " + file("s.exr") + " -o " + file("s.glb") + " --edges 1500,300");
    ASSERT_EQ(made["levels"].size(), 2u) << "two targets and nothing else";
    EXPECT_LE(made["levels"][0]["edges"], 1500);
    EXPECT_LE(made["levels"][1]["edges"], 300);
    const Json alone = json_of("mesh " + file("s.exr") + " -o " + file("s.obj") + " --edges 300,1500");
    ASSERT_EQ(alone["levels"].size(), 2u) << "one file per target, finest first";
    EXPECT_LE(check_mesh(read_mesh(file("s.obj"))).edges, 1500u);
    EXPECT_LE(check_mesh(read_mesh(file("s_LOD1.obj"))).edges, 300u);
}

TEST_F(Command, CubesMethod) {
    const Json made = json_of("mesh " + file("s.exr") + " -o " + file("s.off") + " --method cubes --full");
    ASSERT_EQ(made["levels"].size(), 1u);
    EXPECT_EQ(made["levels"][0]["triangles"], made["fullTriangles"]);
    EXPECT_TRUE(made["levels"][0]["closedManifold"]);
}

TEST_F(Command, RefusalsAreOneLineAndLeaveNothing) {
    write_text(file("cut.exr"), read_text(file("s.exr")).substr(0, 5000));
    write_text(file("bad.ply"), "nonsense");
    std::filesystem::create_directory(file("folder.glb"));
    const std::vector<std::string> before = folder.names();
    expect_one_line(glcast_run("mesh " + file("cut.exr") + " -o " + file("o.glb")), 1, "cut.exr");
    expect_one_line(glcast_run("mesh " + file("none.exr") + " -o " + file("o.glb")), 1, "no such file");
    expect_one_line(glcast_run("mesh " + file("bad.ply") + " -o " + file("o.glb")), 1, "no OpenEXR");
    expect_one_line(glcast_run("mesh " + file("s.exr") + " -o " + file("o.stx")), 1, "name it");
    expect_one_line(glcast_run("mesh " + file("s.exr") + " -o " + file("no/o.glb")), 1, "No such file");
    expect_one_line(glcast_run("mesh " + file("s.exr") + " -o " + file("folder.glb")), 1, "directory");
    expect_one_line(glcast_run("info " + file("bad.ply")), 1, "bad.ply");
    expect_one_line(glcast_run("compare " + file("bad.ply") + " " + file("bad.ply")), 1, "bad.ply");
    expect_one_line(glcast_run("render " + file("bad.ply") + " -o " + file("o.png")), 1, "bad.ply");
    expect_one_line(glcast_run("render " + file("bad.ply") + " -o " + file("o.jpg")), 1, ".png");
    EXPECT_EQ(folder.names(), before);
}

TEST_F(Command, CtrlCLeavesNothing) {
    ASSERT_EQ(write_sphere(file("large.exr"), 160), "");
    for (const char* seconds : {"0.02", "0.1", "0.3"}) {
        run("timeout -s INT " + std::string(seconds) + " " GLCAST_COMMAND " mesh " + file("large.exr") +
            " -o " + file("o.glb"));
        for (const std::string& name : folder.names())
            EXPECT_TRUE(name == "s.exr" || name == "large.exr" || name == "o.glb") << name;
        if (std::filesystem::exists(file("o.glb"))) {
            EXPECT_NO_THROW(read_levels(file("o.glb"))) << "whole or not at all";
        }
    }
}

TEST_F(Command, Usage) {
    for (const char* arguments :
         {"", "frobnicate", "mesh", "mesh a.exr", "mesh a.exr -o b.glb --method spheres",
          "mesh a.exr -o b.glb --edges 1000 --ratio 0.5", "mesh a.exr -o b.glb --close-gaps -1",
          "compare one.ply", "render a.glb -o b.png --size 5"})
        expect_one_line(glcast_run(arguments), 2, "--help");
    EXPECT_EQ(glcast_run("--help").status, 0);
    EXPECT_EQ(glcast_run("mesh --help").status, 0);
    EXPECT_EQ(glcast_run("--version").output, "glcast " GLCAST_VERSION "\n");
}

TEST_F(Command, NamesTheCommandThatWasMeant) {
    expect_one_line(glcast_run("foo"), 2,
                    "no such command: foo; there are mesh, info, compare, refine, render and view");
    expect_one_line(glcast_run("mehs a.exr -o a.glb"), 2,
                    "no such command: mehs; do you mean mesh? There are mesh, info");
    expect_one_line(glcast_run("'\x1b[2J'"), 2, "\\x1b[2J");
}

TEST_F(Command, SaysThatThereIsNoSuchFile) {
    for (const char* ending : {".exr", ".glb", ".obj", ".ply", ".off", ".stl", ".glpm", "", ".xyz"}) {
        const std::string none = file(std::string("none") + ending), output = " -o " + file("o.glb");
        const std::string wanted = "no such file: " + none;
        expect_one_line(glcast_run("info " + none), 1, wanted);
        expect_one_line(glcast_run("compare " + none + " " + none), 1, wanted);
        expect_one_line(glcast_run("mesh " + none + output), 1, wanted);
        expect_one_line(glcast_run("refine " + none + output), 1, wanted);
        expect_one_line(glcast_run("render " + none + " -o " + file("o.png")), 1, wanted);
        expect_one_line(glcast_run("view " + none + " -o " + file("o.html")), 1, wanted);
    }
    expect_one_line(
        glcast_run("render " + file("s.exr") + " --capture " + file("n.exr") + " -o " + file("o.png")), 1,
        "no such file: " + file("n.exr"));
    expect_one_line(glcast_run("info " + file(".")), 1, "is a folder");
}

TEST_F(Command, MaxErrorGivesTheCoarsestLevelWithin) {
    ASSERT_EQ(write_sphere(file("s.exr"), 24), "");                      // small: each limit is a search
    const double sample = 3.0 / 24, diagonal = 2 * 1.2 * std::sqrt(3.0); // of the sphere's box
    const auto level_of = [&](const std::string& limit) {
        const Json made = json_of("mesh " + file("s.exr") + " -o " + file("e.glb") + " --max-error " + limit);
        EXPECT_EQ(made["levels"].size(), 1u) << limit;
        return made["levels"][0];
    };
    const Json half = level_of("0.5"), coarse = level_of("1");
    EXPECT_LE(half["maxErrorSamples"], 0.5);
    EXPECT_LE(coarse["maxErrorSamples"], 1);
    EXPECT_LT(coarse["triangles"], half["triangles"]);
    EXPECT_GT(coarse["triangles"], 8);
    // A fifth fewer triangles are too few.
    const int fewer = half["triangles"].get<int>() * 4 / 5;
    const Json below =
        json_of("mesh " + file("s.exr") + " -o " + file("f.glb") + " --triangles " + std::to_string(fewer));
    EXPECT_GT(below["levels"][0]["maxErrorSamples"], 0.5);
    // The same limit as a part of the diagonal.
    EXPECT_NEAR(level_of(std::to_string(100 * 0.5 * sample / diagonal) + "%")["triangles"].get<double>(),
                half["triangles"].get<double>(), half["triangles"].get<double>() * 0.1);
    for (const char* wrong : {"0", "-1", "x", "1k", "nan"})
        expect_one_line(
            glcast_run("mesh " + file("s.exr") + " -o " + file("e.glb") + " --max-error " + wrong), 2,
            "is no error");
}

TEST_F(Command, WhatCannotBeMetIsSaid) {
    const std::string mesh = "mesh " + file("s.exr") + " -o " + file("s.glb");
    const Json above = json_of(mesh + " --triangles 10000000");
    ASSERT_EQ(above["levels"].size(), 1u);
    EXPECT_EQ(above["levels"][0]["triangles"], above["fullTriangles"]);
    ASSERT_EQ(above["notes"].size(), 1u);
    EXPECT_NE(above["notes"][0].get<std::string>().find("the full surface has no more"), std::string::npos);
    const Json twice = json_of(mesh + " --full --ratio 1");
    EXPECT_EQ(twice["levels"].size(), 1u) << "no level twice";
    EXPECT_EQ(twice["notes"].size(), 1u);
}

TEST_F(Command, PixelsAskForLevels) {
    const Json made =
        json_of("mesh " + file("s.exr") + " -o " + file("s.glb") + " --pixels 6,24 --levels one-file");
    ASSERT_EQ(made["levels"].size(), 2u);
    EXPECT_EQ(made["files"].size(), 1u);
    EXPECT_EQ(made["levels"][0]["asked"], "--pixels 24");
    EXPECT_LE(made["levels"][0]["p999ErrorSamples"], 0.25);
    EXPECT_LE(made["levels"][1]["p999ErrorSamples"], 1.0);
    EXPECT_EQ(read_levels(file("s.glb")).size(), 2u);
}

TEST_F(Command, LevelsOfAnEarlierRunGoWithIt) {
    const std::string mesh = "mesh " + file("s.exr") + " -o " + file("s.glb");
    ASSERT_EQ(glcast_run(mesh + " --triangles 400,200,100").status, 0);
    ASSERT_TRUE(std::filesystem::exists(file("s_LOD2.glb")));
    write_text(file("s_LOD3.glb"), "not ours");
    const Ran ran = glcast_run(mesh + " --triangles 400");
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_FALSE(std::filesystem::exists(file("s_LOD1.glb")));
    EXPECT_FALSE(std::filesystem::exists(file("s_LOD2.glb")));
    EXPECT_EQ(read_text(file("s_LOD3.glb")), "not ours");
    EXPECT_NE(ran.output.find("removed"), std::string::npos);
    EXPECT_NE(ran.output.find("is not of this run"), std::string::npos);
}
