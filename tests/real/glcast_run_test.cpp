// glcast-run against a toy shim: what it refuses before starting anything, what it tells, and what it leaves
// behind (nothing).
#include <nlohmann/json.hpp>

#include "tests/real/glcast_run_fixture.h"

namespace glcast::test {
namespace {

TEST_F(GlcastRun, RefusesWrongUsage) {
    const std::string unit_twice = "1,0,0,0,0,2,0,0,0,0,1,0,0,0,0,1";
    expect_refused({"-n", "7"}, 2, "7");
    expect_refused({"-n", "8193"}, 2, "8193");
    expect_refused({"-n", "many"}, 2, "many");
    expect_refused({"--box", "0,0,0,1,1"}, 2, "six numbers");
    expect_refused({"--box", "0,0,0,1,1,0"}, 2, "must be below");
    expect_refused({"--box", "0,0,0,1,1,nan"}, 2, "six numbers");
    expect_refused({"--frame-matrix", "world"}, 2, "16 numbers");
    expect_refused({"--frame-matrix", unit_twice}, 2, "uniform scale");
    expect_refused({"--frame", "0"}, 2, "0");
    expect_refused({"--frame", "2", "--after", "1"}, 2, "excludes");
    expect_refused({"--normals", "eight"}, 2, "eight");
    for (const char* option : {"--after", "--timeout"})
        for (const char* seconds : {"nan", "-nan", "inf", "-1", "1e9", "soon"})
            expect_refused({option, seconds}, 2, seconds);
    for (const char* degrees : {"nan", "0", "180", "-inf", "wide"})
        expect_refused({"--fov", degrees}, 2, degrees);
    for (const char* key : {"nokey", "F99", "\x1b", ""}) expect_refused({"--key", key}, 2, "needs a key");
    for (const char* signal : {"KILL", "SIGTERM", "99", "NONE"})
        expect_refused({"--signal", signal}, 2, "needs a signal");
    for (const char* layers : {"many", "0", "257", "2.5", "-1"})
        expect_refused({std::string("--layers=") + layers}, 2, "from 1 to 256");
    expect_refused({"--no-such-option"}, 2, "--no-such-option");
    expect_refused({"--"}, 2, "no PROGRAM");
}

TEST_F(GlcastRun, RefusesWhatCannotWork) {
    expect_refused({"-o", folder / "no/such/folder/a.exr"}, 1, "cannot write");
    fs::create_directory(folder / "folder.exr");
    expect_refused({"-o", folder / "folder.exr"}, 1, "it is a folder");
    ASSERT_EQ(mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
    expect_refused({"-o", folder / "pipe.exr"}, 1, "no regular file");
    expect_refused({"-o", folder / "no/../a.exr"}, 1, "cannot write");
    expect_refused({"-o", "/proc/a.exr"}, 1, "cannot write");
    expect_refused({"-o", capture(), "no-such-program-here", "--"}, 1, "no such program");
    expect_refused({"-o", capture(), STATIC_PROGRAM, "--"}, 1, "linked statically");
    std::ofstream(folder / "text") << "just text\n";
    chmod((folder / "text").c_str(), 0755);
    expect_refused({"-o", capture(), folder / "text", "--"}, 1, "neither a program nor a script");
    EXPECT_FALSE(fs::exists(capture()));
}

TEST_F(GlcastRun, RefusesSetuidPrograms) {
    std::string program = "/usr/bin/passwd";
    if (geteuid() == 0) { // what belongs to root gains nothing when root runs it
        program = folder / "borrowed";
        fs::copy_file("/usr/bin/true", program);
        ASSERT_EQ(chown(program.c_str(), 1, 1), 0);
        ASSERT_EQ(chmod(program.c_str(), 04755), 0);
    }
    expect_refused({"-o", capture(), program, "--"}, 1, "setuid");
}

TEST_F(GlcastRun, SaysThatAScriptStartedWhatCannotBeCast) {
    const CommandResult result = run({"--quit", "--timeout", "0.5", "-o", capture(), "--", "sh", "-c",
                                      std::string(STATIC_PROGRAM) + " wait; true"},
                                     "", "toy_static");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("no GL seen: gave up after 0.5 s; "));
    EXPECT_THAT(result.err, HasSubstr("linked statically"));
}

TEST_F(GlcastRun, ReportsTheCastAndEndsTheProgram) {
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", "sleep", nap}, "hooked GLX;casting 3;captured 3 " + capture());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("frame 3 of sleep is cast in " + capture()));
    EXPECT_TRUE(fs::exists(capture()));
}

TEST_F(GlcastRun, SaysFiguresWhenAsked) {
    const auto said = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--quit", "-o", capture(), "--", "sleep", nap});
        const CommandResult result = run(options, "hooked GLX;figures (n=8, 0.1 s);captured 3 " + capture());
        EXPECT_EQ(result.exit_code, 0);
        return result.err;
    };
    EXPECT_EQ(said({}), "glcast-run: frame 3 of sleep is cast in " + capture() +
                            "; to look at it: glcast view " + capture() + " -o " +
                            (folder / "a.html").string() + "\n");
    EXPECT_THAT(said({"--verbose"}), StartsWith("glcast-run: frame 3: (n=8, 0.1 s)\n"));
}

TEST_F(GlcastRun, SaysWhatFailedBesideWhatDidNot) {
    const CommandResult result = run({"--captures", "2", "-o", capture(), "--", "true"},
                                     "hooked GLX;failed no memory;captured 3 " + capture(), "true");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("no memory"));
    EXPECT_THAT(result.err, HasSubstr("only 1 of 2 captures"));
}

TEST_F(GlcastRun, NamesTheCaptureAfterTheProgram) {
    const CommandResult result =
        run({"--quit", "--", "/usr/bin/env", "printenv", "GLCAST_OUT"}, "hooked GLX");
    EXPECT_EQ(result.out, (fs::current_path() / "env.exr").string() + "\n");
}

TEST_F(GlcastRun, EndsAProgramThatIgnoresTheRequest) {
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", "sh", "-c", "trap '' TERM; exec sleep " + nap},
            "hooked GLX;captured 1 a.exr");
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(GlcastRun, EndsEverythingTheProgramStarted) {
    const std::string script = "sleep " + nap + " & setsid sleep " + nap + " & exec sleep " + nap;
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", "sh", "-c", script}, "hooked GLX;captured 1 a.exr");
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(GlcastRun, FollowsALauncherToItsChild) {
    const CommandResult result =
        run({"-o", capture(), "--", "sh", "-c", "(sleep 0.2; date > /dev/null) & exit 0"},
            "hooked EGL;captured 5 a.exr", "date");
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(GlcastRun, SaysWhatWasSeenInstead) {
    const auto why = [&](const std::string& lines, const std::vector<std::string>& program) {
        std::vector<std::string> arguments = {"--quit", "--timeout", "0.5", "-o", capture(), "--"};
        arguments.insert(arguments.end(), program.begin(), program.end());
        const CommandResult result = run(arguments, lines, program[0]);
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_FALSE(fs::exists(capture()));
        return result.err;
    };
    EXPECT_EQ(why("", {"true"}), "glcast-run: no GL seen: the program ended\n");
    EXPECT_EQ(why("", {"sleep", nap}), "glcast-run: no GL seen: gave up after 0.5 s\n");
    EXPECT_THAT(why("hooked GLX", {"true"}), HasSubstr("GLX seen, but no whole frame"));
    EXPECT_THAT(why("hooked EGL;frames 1;frames 8", {"sleep", nap}),
                HasSubstr("8 frames or more seen through EGL, none with solid geometry"));
    EXPECT_THAT(why("hooked GLX;casting 2", {"true"}), HasSubstr("the capture of frame 2 was not complete"));
    EXPECT_EQ(why("hooked GLX;failed no framebuffer objects", {"sleep", nap}),
              "glcast-run: no framebuffer objects\n");
}

TEST_F(GlcastRun, NamesHeadlessWhereThereIsNoScreen) {
    const auto said = [&](const std::string& display) {
        const CommandResult result =
            run({"--quit", "-o", capture(), "--", "true"}, "", "true", {{"DISPLAY", display}});
        EXPECT_EQ(result.exit_code, 1);
        return result.err;
    };
    EXPECT_THAT(said(""), HasSubstr("DISPLAY is not set"));
    EXPECT_THAT(said(""), HasSubstr("--headless"));
    EXPECT_THAT(said(":987654"), HasSubstr("no X server answers at DISPLAY=:987654: --headless"));
    EXPECT_THAT(said("elsewhere:0"), Not(HasSubstr("--headless"))) << "it is not asked";
}

TEST_F(GlcastRun, WritesControlCharactersOut) {
    const CommandResult failed =
        run({"--quit", "-o", capture(), "--", "sleep", nap}, "hooked GLX;failed a\x1b]0;title\x07 b\rc");
    EXPECT_THAT(failed.err, HasSubstr("a\\x1b]0"));
    EXPECT_THAT(failed.err, Not(HasSubstr("\x1b")));
    expect_refused({"-o", folder / "a\nb.txt"}, 2, "a\\x0ab.txt");
    const CommandResult listed =
        run({"--list", "--", "sleep", nap}, "hooked GLX;group 1 a \x1b[2J window;listed 1");
    EXPECT_EQ(listed.out, "1 a \\x1b[2J window\n");
}

TEST_F(GlcastRun, TellsAScriptInJson) {
    const CommandResult cast =
        run({"--json", "--quit", "-o", capture(), "--", "sh", "-c", "echo drawn; exec sleep " + nap},
            "hooked GLX;figures (n=8);captured 3 " + capture(), "sleep"); // when it has printed
    EXPECT_EQ(cast.exit_code, 0) << cast.err;
    const auto told = nlohmann::json::parse(cast.out);
    EXPECT_EQ(told["program"], "sh");
    EXPECT_EQ(told["captures"][0]["frame"], 3);
    EXPECT_EQ(told["captures"][0]["figures"], "(n=8)");
    EXPECT_EQ(told["captures"][0]["capture"], capture());
    EXPECT_EQ(cast.err, "drawn\n") << "what the program prints, and nothing of ours";
    const CommandResult listed =
        run({"--json", "--list", "--", "sleep", nap}, "hooked GLX;group 1 gears;group 2 wall;listed 1");
    EXPECT_EQ(nlohmann::json::parse(listed.out)["groups"], (std::vector<std::string>{"1 gears", "2 wall"}));
}

TEST_F(GlcastRun, PassesOnCtrlC) {
    const CommandResult result =
        run({"-o", capture(), "--", "sh", "-c", "kill -INT $PPID; exec sleep " + nap}, "hooked GLX");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("interrupted"));
}

TEST_F(GlcastRun, ListsGroupsOnStandardOutput) {
    const CommandResult result =
        run({"--list", "--", "sleep", nap}, "hooked GLX;group 1 three gears;group 2 a wall;listed 1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "1 three gears\n2 a wall\n");
}

TEST_F(GlcastRun, WaitsForTheLastWordOfSeveralWindows) {
    const CommandResult listed =
        run({"--list", "--", "sleep", nap},
            "hooked GLX;looks 1 a, 2 b;group 1 gears;listed 1;group 1 a wall;listed 1;settled ");
    EXPECT_EQ(listed.out, "1 gears\n1 a wall\n");
    const CommandResult cast =
        run({"--quit", "-o", capture(), "--", "sleep", nap},
            "hooked GLX;looks 1 a, 2 b;captured 3 " + capture() + ";recaptured 5 " + capture() + ";settled ");
    EXPECT_EQ(cast.exit_code, 0) << cast.err;
    EXPECT_THAT(cast.err, HasSubstr("frame 5 of sleep is cast in"));
    const CommandResult killed = run({"--timeout", "1", "--quit", "-o", capture(), "--", "sleep", nap},
                                     "hooked GLX;looks 1 a, 2 b;captured 3 " + capture());
    EXPECT_EQ(killed.exit_code, 0) << killed.err; // what is captured is captured
}

TEST_F(GlcastRun, HandsItsOptionsToTheShim) {
    const CommandResult result = run({"-n", "64", "--normals", "six", "--layers", "3", "--box", "0,0,0,1,1,1",
                                      "--group", "2", "--frame", "7", "-o", capture(), "--", "env"});
    for (const char* variable : {"GLCAST_N=64\n", "GLCAST_NORMALS=six\n", "GLCAST_LAYERS=3\n",
                                 "GLCAST_BOX=0,0,0,1,1,1\n", "GLCAST_GROUP=2\n", "GLCAST_FRAME=7\n"}) {
        EXPECT_THAT(result.out, HasSubstr(variable));
    }
    EXPECT_THAT(result.out, Not(HasSubstr("GLCAST_QUIT")));
    EXPECT_THAT(result.out, HasSubstr("GLCAST_OUT=" + capture()));
}

TEST_F(GlcastRun, KeepsOtherPreloads) {
    const CommandResult result =
        run({"-o", capture(), "--", "printenv", "LD_PRELOAD"}, "", "", {{"LD_PRELOAD", "libm.so.6"}});
    EXPECT_EQ(result.out, std::string(TOY_SHIM) + ":libm.so.6\n");
}

TEST_F(GlcastRun, PreloadsFromAFolderWithASpace) {
    fs::create_directories(folder / "a b");
    fs::copy_file(TOY_SHIM, folder / "a b/libglcast.so");
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", "sleep", nap}, "hooked GLX;captured 1 a.exr", "sleep",
            {{"GLCAST_LIBRARY", folder / "a b/libglcast.so"}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

#ifdef TOY_SLEEP_I386
class GlcastRun32 : public GlcastRun {
  protected:
    /// The toy as it is installed, for 64 bits, and for 32 when `both`.
    std::string install(const std::string& prefix, bool both) {
        // lib32 is what the loader of libc6-i386 puts for $LIB.
        for (const auto& [lib, toy] :
             {std::pair{"lib/x86_64-linux-gnu", TOY_SHIM}, std::pair{"lib/i386-linux-gnu", TOY_SHIM_I386},
              std::pair{"lib32", TOY_SHIM_I386}}) {
            const fs::path place = folder / prefix / lib / "glcast";
            fs::create_directories(place);
            if (both || std::string(toy) == TOY_SHIM) fs::copy_file(toy, place / "libglcast.so");
        }
        return folder / prefix;
    }
};

TEST_F(GlcastRun32, IsRefusedWithoutItsLibrary) {
    const std::string prefix = install("p", false);
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", TOY_SLEEP_I386, "1"}, "", "toy_sleep",
            {{"GLCAST_LIBRARY", prefix + "/lib/x86_64-linux-gnu/glcast/libglcast.so"}});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("is a 32-bit program, and the library for those is not there"));
    EXPECT_THAT(result.err, HasSubstr("libglcast0:i386"));
}

TEST_F(GlcastRun32, TakesItsOwnLibrary) {
    for (const char* prefix : {"p", "a b"}) {
        const std::string place = install(prefix, true);
        for (const std::string& library :
             {place + "/$LIB/glcast/libglcast.so", place + "/lib/x86_64-linux-gnu/glcast/libglcast.so"}) {
            const CommandResult result =
                run({"--quit", "-o", capture(), "--", TOY_SLEEP_I386, "30"},
                    "hooked GLX;captured 1 " + capture(), "toy_sleep", {{"GLCAST_LIBRARY", library}});
            EXPECT_EQ(result.exit_code, 0) << result.err;
            EXPECT_THAT(result.err, Not(HasSubstr("ELF class"))) << library;
        }
    }
}

TEST_F(GlcastRun32, IsStartedByAScriptOf64Bits) {
    const std::string library = install("p", true) + "/$LIB/glcast/libglcast.so";
    const CommandResult result =
        run({"--quit", "-o", capture(), "--", "sh", "-c", std::string(TOY_SLEEP_I386) + " 30; true"},
            "hooked GLX;captured 1 " + capture(), "toy_sleep", {{"GLCAST_LIBRARY", library}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("ELF class")));
}
#endif

TEST_F(GlcastRun, BringsItsOwnScreenAndTakesItAway) {
    const CommandResult result = run({"--headless", "-o", capture(), "--", "sh", "-c",
                                      "echo $DISPLAY; test -S /tmp/.X11-unix/X${DISPLAY#:} && echo there"});
    ASSERT_THAT(result.out, StartsWith(":")) << result.err;
    EXPECT_THAT(result.out, HasSubstr("there"));
    const std::string display = result.out.substr(1, result.out.find('\n') - 1);
    EXPECT_FALSE(fs::exists("/tmp/.X11-unix/X" + display));
}

} // namespace
} // namespace glcast::test
