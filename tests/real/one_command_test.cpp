// glcast-run -o NAME.glb: the cast and its mesh in one command, against a toy shim; for what must happen at a certain moment
// also against a toy glcast.
#include <nlohmann/json.hpp>

#include "tests/file/sphere_capture.h"
#include "tests/real/glcast_run_fixture.h"
#include "tools/io/mesh_endings.h"
#include "tools/io/mesh_io.h"

namespace glcast::test {
namespace {
using Json = nlohmann::json;
using testing::ElementsAre;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

class OneCommand : public GlcastRun {
  protected:
    OneCommand() {
        EXPECT_EQ(samples::write_sphere(folder / "tmp.exr", 24), "");
        fs::create_directory(folder / "out");
    }

    std::string out(const std::string& name) const { return folder / "out" / name; }

    CommandResult cast(std::vector<std::string> options, const std::vector<std::string>& program,
                       const std::string& toy_lines, const std::string& capture = "tmp.exr") {
        options.emplace_back("--");
        options.insert(options.end(), program.begin(), program.end());
        return run(options, toy_lines, program[0], {{"TOY_CAPTURE", folder / capture}, {"FOLDER", folder}});
    }

    std::vector<std::string> made() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder / "out")) names.push_back(entry.path().filename());
        return names;
    }

    /// From now on glcast-run finds this script beside itself instead of glcast. "$1" is mesh; the capture and the mesh are
    /// "$2" and "$4". That it could write is not asked of it.
    void put_toy_glcast(const std::string& script) {
        fs::create_directory(folder / "bin");
        fs::copy_file(GLCAST_RUN, folder / "bin/glcast-run");
        std::ofstream(folder / "bin/glcast") << "#!/bin/sh\ncase \"$*\" in *--rehearse*) exit 0 ;; esac\n" << script << '\n';
        chmod((folder / "bin/glcast").c_str(), 0755);
        command = folder / "bin/glcast-run";
    }
};

/// Shell that goes on when the file is there.
std::string await(const std::string& file) { return "until [ -e \"" + file + "\" ]; do sleep 0.02; done; "; }

TEST_F(OneCommand, TheMeshIsThereAndTheCaptureIsGone) {
    const CommandResult result =
        cast({"--quit", "-o", out("a.glb")}, {"sleep", nap}, "hooked GLX;casting 3;cast 3");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(made(), testing::Contains("a.glb"));
    EXPECT_THAT(made(), testing::Each(Not(testing::EndsWith(".exr"))));
    const std::vector<Level> levels = read_levels(out("a.glb"));
    EXPECT_GT(levels[0].mesh.triangles.size(), 100u);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("triangles"));
    EXPECT_THAT(result.err, Not(HasSubstr("glcast-run: "))) << "the mesh's own line says it";
}

TEST_F(OneCommand, EveryEndingOfAMesh) {
    for (const std::string_view ending : mesh_endings) {
        const std::string name = "a" + std::string(ending);
        const CommandResult result = cast({"--quit", "-o", out(name)}, {"sleep", nap}, "hooked GLX;cast 1");
        EXPECT_EQ(result.exit_code, 0) << ending << result.err;
        EXPECT_TRUE(fs::exists(out(name))) << ending;
    }
}

TEST_F(OneCommand, OptionsOfTheMeshArePassedOn) {
    const CommandResult result =
        cast({"--quit", "--json", "--triangles", "300,100", "--normals", "geometric", "--check", "-o", out("a.ply")},
             {"sleep", nap}, "hooked GLX;cast 3");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json told = Json::parse(result.out);
    EXPECT_EQ(told["program"], "sleep");
    ASSERT_EQ(told["captures"].size(), 1u);
    EXPECT_EQ(told["captures"][0]["frame"], 3);
    EXPECT_FALSE(told["captures"][0].contains("capture")) << "it is gone";
    const Json levels = told["captures"][0]["mesh"]["levels"];
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_LE(levels[0]["triangles"], 300);
    EXPECT_LE(levels[1]["triangles"], 100);
    EXPECT_EQ(levels[0]["selfIntersections"], 0);
}

TEST_F(OneCommand, EveryOptionOfGlcastMeshIsKnown) {
    const auto options_of = [](const std::vector<std::string>& command) {
        std::vector<std::string> names;
        std::istringstream help(run_command(command, 30).out);
        for (std::string line; std::getline(help, line);)
            if (const std::size_t at = line.find("--"); at != std::string::npos && at < 8 && line.starts_with("  -"))
                names.push_back(line.substr(at, line.find_first_of(" ,", at) - at));
        return names;
    };
    const std::vector<std::string> ours = options_of({GLCAST_RUN, "--help"});
    for (const std::string& option : options_of({GLCAST, "mesh", "--help"}))
        EXPECT_THAT(ours, testing::Contains(option)) << "add it to tools/run/mesh_options.h";
}

TEST_F(OneCommand, WhatCannotWorkIsRefusedBeforeTheProgramStarts) {
    for (const char* name : {"a.foo", "a", "a.glb.gz", "a.exr.bak", "a.GLB "}) expect_refused({"-o", out(name)}, 2, ".exr");
    expect_refused({"-o", capture(), "--triangles", "100"}, 2, "--triangles is of a mesh");
    expect_refused({"--texture", "64"}, 2, "--texture is of a mesh");
    expect_refused({"-o", capture(), "--normals", "geometric"}, 2, "--normals is of a mesh");
    expect_refused({"-o", out("a.glb"), "--texture", "100"}, 2, "--texture");
    expect_refused({"-o", out("a.glb"), "--triangles", "many"}, 2, "--triangles");
    expect_refused({"-o", out("a.glb"), "--triangles", "500", "--edges", "10"}, 2, "--edges");
    expect_refused({"-o", out("a.ply"), "--compress", "meshopt"}, 1, "--compress");
    expect_refused({"-o", folder / "no/a.glb"}, 1, "cannot write");
    fs::create_directory(out("folder.glb"));
    expect_refused({"-o", out("folder.glb")}, 1, "cannot write");
    fs::create_directory(out("b.exr"));
    expect_refused({"-o", out("b.glb"), "--keep-capture"}, 1, "it is a folder");
    put_toy_glcast("");
    fs::remove(folder / "bin/glcast");
    expect_refused({"-o", out("a.glb")}, 1, "cannot find glcast");
}

TEST_F(OneCommand, AMeshForEachFrame) {
    const CommandResult result =
        cast({"--captures", "3", "--quit", "-o", out("a.%f.ply")}, {"sleep", nap}, "hooked GLX;cast 3;cast 7;cast 20");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(made(), testing::IsSupersetOf({"a.3.ply", "a.7.ply", "a.20.ply"}));
}

TEST_F(OneCommand, TooFewFramesAreSaid) {
    const CommandResult result =
        cast({"--captures", "3", "-o", out("a.%f.ply")}, {"true"}, "hooked GLX;cast 3;cast 7");
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(made(), testing::IsSupersetOf({"a.3.ply", "a.7.ply"})) << "what is captured is captured";
    EXPECT_THAT(result.err, HasSubstr("only 2 of 3 captures: the program ended"));
}

TEST_F(OneCommand, TheCaptureIsKeptWhenAsked) {
    const CommandResult result = cast({"--quit", "--keep-capture", "-o", out("a.%f.glb"), "--json"}, {"sleep", nap},
                                      "hooked GLX;cast 3");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(made(), testing::IsSupersetOf({"a.3.glb", "a.3.exr"}));
    EXPECT_EQ(Json::parse(result.out)["captures"][0]["capture"], out("a.3.exr"));
}

TEST_F(OneCommand, AMeshThatFailsLeavesNothing) {
    std::ofstream(folder / "bad.exr") << "nonsense";
    const CommandResult result =
        cast({"--quit", "-o", out("a.glb")}, {"sleep", nap}, "hooked GLX;cast 3", "bad.exr");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(made(), ElementsAre());
    EXPECT_THAT(result.err, HasSubstr("frame 3 is captured, but " + out("a.glb") + " is not made; with --keep-capture"));
    const CommandResult kept =
        cast({"--quit", "--keep-capture", "-o", out("a.glb")}, {"sleep", nap}, "hooked GLX;cast 3", "bad.exr");
    EXPECT_EQ(kept.exit_code, 1);
    EXPECT_THAT(made(), ElementsAre("a.exr"));
    EXPECT_THAT(kept.err, HasSubstr("its capture is kept in " + out("a.exr")));
}

TEST_F(OneCommand, NothingIsMadeWhereNothingIsCast) {
    const CommandResult result = cast({"--quit", "--timeout", "0.5", "-o", out("a.glb")}, {"sleep", nap}, "hooked GLX");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(made(), ElementsAre());
    EXPECT_THAT(result.err, HasSubstr("gave up after 0.5 s"));
}

TEST_F(OneCommand, TheMeshIsMadeWhileTheProgramGoesOn) {
    const CommandResult result = cast({"-o", out("a.ply")}, {"sh", "-c", await(out("a.ply")) + "echo seen"}, "hooked GLX;cast 3");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "seen\n");
}

TEST_F(OneCommand, TheMeshIsMadeOfTheWindowThatShowsMost) {
    put_toy_glcast("cat \"$2\" > \"$4\"");
    const CommandResult result = cast({"--quit", "-o", out("%f.ply")}, {"sleep", nap},
                                      "hooked GLX;looks 1 a, 2 b;cast 3;recaptured 5 " + (folder / "tmp.exr").string() + ";settled ");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::exists(folder / "tmp.exr")) << "what is not ours to remove stays";
    EXPECT_EQ(fs::file_size(out("5.ply")), fs::file_size(folder / "tmp.exr"));
}

TEST_F(OneCommand, CtrlCWhileTheMeshIsMadeLeavesNothing) {
    put_toy_glcast("trap 'echo ended > \"$FOLDER/ended\"; exit 143' TERM\n: > \"$FOLDER/begun\"\n"
                   "while :; do sleep 0.02; done");
    const std::string interrupt = await("$FOLDER/begun") + "kill -INT $PPID; exec sleep " + nap;
    const CommandResult result = cast({"-o", out("a.glb")}, {"sh", "-c", interrupt}, "hooked GLX;cast 3");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(fs::exists(folder / "ended")) << "the mesh was ended politely";
    EXPECT_THAT(made(), ElementsAre());
    EXPECT_THAT(result.err, HasSubstr("is not made"));
}

TEST_F(OneCommand, CtrlCAfterTheProgramHasEndedDoesToo) {
    put_toy_glcast(": > \"$FOLDER/begun\"\nkill -INT $PPID\nwhile :; do sleep 0.02; done");
    const CommandResult result = cast({"--keep-capture", "-o", out("a.glb")}, {"true"}, "hooked GLX;cast 3");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(made(), ElementsAre("a.exr"));
    EXPECT_THAT(result.err, HasSubstr("its capture is kept in " + out("a.exr")));
}

TEST_F(OneCommand, TheTimeLimitIsOfTheCastAlone) {
    put_toy_glcast("sleep 1; : > \"$4\"");
    const CommandResult result =
        cast({"--timeout", "0.5", "-o", out("a.glb")}, {"sh", "-c", await(out("a.glb"))}, "hooked GLX;cast 3");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(made(), ElementsAre("a.glb"));
}

TEST_F(OneCommand, MeshesOfOneNameAreMadeOfTheLast) {
    put_toy_glcast("echo \"$2\" >> \"$FOLDER/made\"; " + await("$FOLDER/go") + ": > \"$4\"");
    const CommandResult result =
        cast({"--captures", "3", "-o", out("a.glb")}, {"sh", "-c", await("$FOLDER/made") + ": > $FOLDER/go"},
             "hooked GLX;cast 1;cast 2;cast 3");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::ifstream file(folder / "made");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    EXPECT_THAT(lines.back(), testing::EndsWith(".3.exr"));
    EXPECT_LE(lines.size(), 2u) << "what is overwritten at once is not made";
}

} // namespace
} // namespace glcast::test
