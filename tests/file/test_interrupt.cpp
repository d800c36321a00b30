// Ctrl-C at every stage of glcast mesh, on a terminal of its own: nothing is left, and progress is told there alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;

namespace {

struct OnTerminal {
    int status = -1; ///< as of wait()
    std::string output;
};

/// What is preloaded into glcast.
struct Ways {
    bool without_tmpfile = false; ///< temporaries have names
    bool halted = false;          ///< it goes no further than the stage, until the signal comes
};

/// Runs glcast on a terminal; `signal` is sent as soon as `stage` is shown.
OnTerminal on_terminal(const std::vector<std::string>& arguments, const std::string& stage, int signal, const Ways& ways = {}) {
    OnTerminal ran;
    int terminal = -1;
    const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (pid == 0) {
        const std::string preload = std::string(ways.without_tmpfile ? GLCAST_NO_TMPFILE : "") + ":" +
                                    (ways.halted ? GLCAST_HALT_AT_STAGE : "");
        if (preload != ":") setenv("LD_PRELOAD", preload.c_str(), 1);
        if (ways.halted) setenv("GLCAST_TEST_STAGE", stage.c_str(), 1);
        alarm(200); // whatever happens, it ends
        std::vector<char*> words{const_cast<char*>(GLCAST_COMMAND)};
        for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
        words.push_back(nullptr);
        execv(words[0], words.data());
        _exit(127);
    }
    bool sent = false;
    char buffer[4096];
    for (ssize_t got; (got = read(terminal, buffer, sizeof buffer)) > 0;) {
        ran.output.append(buffer, static_cast<std::size_t>(got));
        if (!sent && !stage.empty() && ran.output.find(stage) != std::string::npos) {
            kill(pid, signal);
            sent = true;
        }
    }
    waitpid(pid, &ran.status, 0);
    close(terminal);
    EXPECT_EQ(sent, !stage.empty()) << ran.output;
    return ran;
}

class Interrupt : public testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(write_sphere(file("s.exr"), 40), ""); }
    std::string file(const std::string& name) const { return (folder / name).string(); }

    /// What is there beside the capture.
    std::vector<std::string> written() const {
        std::vector<std::string> names = folder.names();
        std::erase(names, "s.exr");
        return names;
    }

    /// `outputs`: the mesh first. Ended with the signal's code and nothing left; or, when the signal came too
    /// late, every file in place and whole.
    bool interrupted(const OnTerminal& ran, int signal, const std::vector<std::string>& outputs) {
        EXPECT_TRUE(WIFEXITED(ran.status)) << ran.output;
        const int code = WEXITSTATUS(ran.status);
        EXPECT_TRUE(code == 128 + signal || code == 0) << code << ran.output;
        EXPECT_EQ(ran.output.find("glcast: interrupted") != std::string::npos, code != 0) << ran.output;
        if (code != 0 && written().empty()) return true;
        std::vector<std::string> sorted = outputs;
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(written(), sorted) << ran.output;
        EXPECT_NO_THROW(read_all_levels(file(outputs.front())));
        for (const std::string& name : written()) std::filesystem::remove(file(name));
        return false;
    }
    Folder folder;
};

} // namespace

TEST_F(Interrupt, AtEveryStageNothingIsLeft) {
    for (const bool without_tmpfile : {false, true})
        for (const char* stage : {"reading", "making the surface", "simplifying", "measuring", "writing"}) {
            const int signal = stage[0] == 'm' ? SIGTERM : SIGINT;
            const OnTerminal ran = on_terminal({"mesh", file("s.exr"), "-o", file("o.glb"), "--full"}, stage, signal,
                                               {.without_tmpfile = without_tmpfile, .halted = true});
            EXPECT_TRUE(interrupted(ran, signal, {"o.glb"})) << stage << ": not ended\n" << ran.output;
        }
}

TEST_F(Interrupt, WhileFilesAreWrittenAllOrNothingIsLeft) {
    for (const std::string ending : {"glb", "obj", "ply"}) {
        const std::vector<std::string> mesh{"mesh",    file("s.exr"), "-o", file("o." + ending),
                                            "--ratio", "0.2,0.1"};
        EXPECT_EQ(on_terminal(mesh, "", 0).status, 0);
        std::vector<std::string> names = written(); // textures of .obj and .ply too
        EXPECT_TRUE(std::erase(names, "o." + ending) == 1 &&
                    std::find(names.begin(), names.end(), "o_LOD1." + ending) != names.end());
        names.insert(names.begin(), "o." + ending);
        for (const std::string& name : names) std::filesystem::remove(file(name));
        for (const char* stage : {"measuring", "writing"})
            interrupted(on_terminal(mesh, stage, SIGINT, {.without_tmpfile = true}), SIGINT, names);
    }
}

TEST_F(Interrupt, AnIgnoredSignalStaysIgnored) {
    const Ran ran = run("trap \"\" HUP; " GLCAST_COMMAND " mesh " + file("s.exr") + " -o " + file("o.glb") +
                        " & kill -HUP $!; wait $!");
    EXPECT_EQ(ran.status, 0) << ran.output;
}

TEST_F(Interrupt, ProgressIsForTerminals) {
    const OnTerminal shown = on_terminal({"mesh", file("s.exr"), "-o", file("o.glb")}, "", 0);
    EXPECT_EQ(shown.status, 0);
    for (const char* stage : {"reading", "making the surface", "simplifying", "measuring", "writing"})
        EXPECT_NE(shown.output.find(stage), std::string::npos) << stage;
    const Ran piped = run(GLCAST_COMMAND " mesh " + file("s.exr") + " -o " + file("o.glb"));
    EXPECT_EQ(piped.status, 0);
    EXPECT_EQ(piped.output.find("..."), std::string::npos) << piped.output;
    EXPECT_EQ(piped.output.find_first_of("\r\033"), std::string::npos) << piped.output;
}
