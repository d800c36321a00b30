// What a command does with hostile input, options and surroundings: one line and a status, never a crash, a
// hang or a lost word.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

const std::string glcast_command = GLCAST_COMMAND;

class HostileCommand : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(write_sphere(folder / "s.exr", 16), "");
        write_text(folder / "t.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    }
    /// In the folder, `glcast ARGUMENTS`.
    Ran glcast(const std::string& arguments, const std::string& before = "") {
        return run("cd " + folder.path().string() + " && " + before + glcast_command + " " + arguments);
    }
    void expect_refused(const Ran& ran, int status, const std::string& why) {
        EXPECT_EQ(ran.status, status) << ran.output;
        EXPECT_NE(ran.output.find(why), std::string::npos)
            << '"' << ran.output << "\" has no \"" << why << '"';
        EXPECT_EQ(std::count(ran.output.begin(), ran.output.end(), '\n'), 1) << "one line: " << ran.output;
    }
    Folder folder;
};

} // namespace

TEST_F(HostileCommand, TrianglesThatLieOnOneAnotherAreCountedToABound) {
    std::string same = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", near;
    for (int k = 0; k < 20'000; ++k) same += "f 1 2 3\n";
    // Long and thin ones, side by side and aslant: each is in the box of each, and none meets another.
    for (int k = 0; k < 20'000; ++k) {
        const std::string x = std::to_string(k * 1e-4), y = std::to_string(100 - k * 1e-4);
        near += "v " + x + " 0 0\nv " + x + " 1e-6 0\nv " + std::to_string(100 + k * 1e-4) + " 100 100\n";
        near += "f -3 -2 -1\n";
    }
    write_text(folder / "same.obj", same);
    const Ran ran = glcast("info same.obj");
    EXPECT_EQ(ran.status, 0);
    EXPECT_NE(ran.output.find("more than 1000000 self-intersections"), std::string::npos) << ran.output;
    EXPECT_NE(glcast("info --json same.obj").output.find("\"moreSelfIntersections\": true"),
              std::string::npos);
    write_text(folder / "near.obj", near);
    EXPECT_EQ(glcast("info near.obj").status, 0);
    EXPECT_NE(glcast("info t.obj").output.find("no self-intersections"), std::string::npos);
}

TEST_F(HostileCommand, WhatCannotBeMeasuredIsRefused) {
    const std::string found = GLCAST_HOSTILE_FILES "/obj-edges-of-1e155-abort-compare.obj";
    write_text(folder / "far.obj", "v 1e19 0 0\nv 1e19 1 0\nv 1e19 0 1\nf 1 2 3\n");
    for (const std::string& huge : {found, std::string("far.obj")}) {
        expect_refused(glcast("compare " + huge + " " + huge), 1, "1.8e18");
        expect_refused(glcast("compare t.obj " + huge), 1, "1.8e18");
        expect_refused(glcast("compare " + huge + " t.obj"), 1, "1.8e18");
        expect_refused(glcast("info " + huge), 1, "1.8e18");
    }
    EXPECT_EQ(glcast("compare t.obj t.obj").status, 0);
}

TEST_F(HostileCommand, NumbersOfOptionsAreFinite) {
    const std::string mesh = "mesh s.exr -o o.glb ";
    for (const char* value : {"nan", "-nan", "inf", "-inf", "NAN", "1e999"})
        for (const std::string& option :
             {mesh + "--triangles=", mesh + "--edges=", mesh + "--ratio=", mesh + "--close-gaps=",
              mesh + "--sheet-thickness=", std::string("compare t.obj t.obj --sample="),
              std::string("refine s.glpm -o o.glb --ratio=")})
            expect_refused(glcast(option + value), 2, "see glcast");
    for (const char* option : {"--triangles=-1", "--edges=-5", "--ratio=-0.1", "--close-gaps=-1",
                               "--sheet-thickness=-1", "--triangles="})
        expect_refused(glcast(mesh + option), 2, "see glcast");
    EXPECT_FALSE(std::filesystem::exists(folder / "o.glb"));
}

TEST_F(HostileCommand, LimitsOfTheSystemAreOneLine) {
    expect_refused(glcast("mesh s.exr -o o.glb", "ulimit -f 0; "), 1, "File too large");
    EXPECT_FALSE(std::filesystem::exists(folder / "o.glb"));
    for (const int kilobytes : {60'000, 100'000, 140'000, 200'000, 300'000, 500'000}) {
        const Ran ran = glcast("mesh s.exr -o o.glb", "ulimit -v " + std::to_string(kilobytes) + "; ");
        // 127 is the loader's: the libraries do not fit.
        EXPECT_TRUE(ran.status == 0 || ran.status == 1 || ran.status == 127)
            << kilobytes << ": " << ran.output;
        EXPECT_EQ(ran.output.find("terminate called"), std::string::npos) << kilobytes << ": " << ran.output;
        EXPECT_EQ(ran.output.find("std::bad_alloc"), std::string::npos) << kilobytes << ": " << ran.output;
    }
}

TEST_F(HostileCommand, WhatIsNotPrintedIsAFailure) {
    for (const char* arguments : {"info s.exr", "info t.obj", "info --json s.exr", "compare t.obj t.obj",
                                  "--help", "mesh --help", "--version"}) {
        const Ran ran = glcast(std::string(arguments) + " >/dev/full");
        expect_refused(ran, 1, "standard output");
    }
}

TEST_F(HostileCommand, WhatIsReplacedKeepsItsRights) {
    write_text(folder / "o.glb", "secret");
    std::filesystem::permissions(folder / "o.glb", std::filesystem::perms(0600));
    EXPECT_EQ(glcast("mesh s.exr -o o.glb", "umask 022; ").status, 0);
    EXPECT_EQ(int(std::filesystem::status(folder / "o.glb").permissions()), 0600);
    EXPECT_GT(std::filesystem::file_size(folder / "o.glb"), 100u);
    std::filesystem::permissions(folder / "o.glb", std::filesystem::perms(0664));
    EXPECT_EQ(glcast("mesh s.exr -o o.glb", "umask 077; ").status, 0);
    EXPECT_EQ(int(std::filesystem::status(folder / "o.glb").permissions()), 0664);
    EXPECT_EQ(glcast("mesh s.exr -o new.glb", "umask 027; ").status, 0);
    EXPECT_EQ(int(std::filesystem::status(folder / "new.glb").permissions()), 0640);
}

TEST_F(HostileCommand, ALinkIsReplacedAndItsTargetLeftAlone) { // as docs/reference/files.md says
    write_text(folder / "target.glb", "mine");
    std::filesystem::create_symlink("target.glb", folder / "link.glb");
    std::filesystem::create_symlink("nowhere.glb", folder / "dangling.glb");
    EXPECT_EQ(glcast("mesh s.exr -o link.glb").status, 0);
    EXPECT_EQ(glcast("mesh s.exr -o dangling.glb").status, 0);
    EXPECT_EQ(read_text(folder / "target.glb"), "mine");
    EXPECT_FALSE(std::filesystem::exists(folder / "nowhere.glb"));
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / "link.glb")));
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / "dangling.glb")));
}

TEST_F(HostileCommand, AFolderThatIsNotThereIsNotPassedOver) {
    expect_refused(glcast("mesh s.exr -o nofolder/../o.glb"), 1, "No such file");
    EXPECT_FALSE(std::filesystem::exists(folder / "o.glb"));
}

TEST_F(HostileCommand, DevicesAndPipesAreSaidToBeSuch) {
    ASSERT_EQ(mkfifo((folder / "fifo.glb").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo((folder / "fifo.exr").c_str(), 0600), 0);
    expect_refused(glcast("mesh s.exr -o fifo.glb"), 1, "a device or a pipe");
    expect_refused(glcast("info fifo.glb"), 1, "no regular file"); // and nobody waits
    expect_refused(glcast("info fifo.exr"), 1, "no regular file");
    expect_refused(glcast("mesh fifo.exr -o o.glb"), 1, "no regular file");
    expect_refused(glcast("info none.exr"), 1, "o such file");
}
