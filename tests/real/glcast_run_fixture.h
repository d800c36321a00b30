// glcast-run against a toy shim, in a folder of its own, of which nothing may be left but what the test looks for.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/real/command.h"

namespace glcast::test {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class GlcastRun : public testing::Test {
  protected:
    GlcastRun() {
        fs::create_directory(folder / "tmp");
        // A duration that no other process has: whatever still sleeps for it afterwards was left behind.
        nap = "9" + std::to_string(getpid()) + "." + std::to_string(++count);
    }
    ~GlcastRun() override { fs::remove_all(folder); }

    CommandResult run(std::vector<std::string> arguments, const std::string& toy_lines = "",
                      const std::string& toy_process = "sleep",
                      std::vector<std::pair<std::string, std::string>> more = {}) {
        arguments.insert(arguments.begin(), command);
        more.insert(more.begin(), {{"GLCAST_LIBRARY", TOY_SHIM},
                                   {"TMPDIR", folder / "tmp"},
                                   {"DISPLAY", "elsewhere:0"},
                                   {"TOY_LINES", toy_lines},
                                   {"TOY_PROCESS", toy_process}});
        const CommandResult result = run_command(arguments, 60, more);
        EXPECT_FALSE(result.timed_out);
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "something was left in the folder for temporary files";
        EXPECT_FALSE(still_napping()) << "a process of the program was left behind";
        return result;
    }

    bool still_napping() const {
        for (const auto& entry : fs::directory_iterator("/proc")) {
            std::ifstream file(entry.path() / "cmdline");
            std::stringstream text;
            text << file.rdbuf();
            if (text.str().starts_with("sleep") && text.str().find(nap) != std::string::npos) {
                return true;
            }
        }
        return false;
    }

    void expect_refused(const std::vector<std::string>& options, int exit_code, const std::string& reason) {
        std::vector<std::string> arguments = options;
        if (arguments.empty() || arguments.back() != "--") {
            arguments.insert(arguments.end(), {"--", "touch", folder / "started"});
        } else {
            arguments.pop_back();
        }
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_THAT(result.err, StartsWith("glcast-run: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(fs::exists(folder / "started")) << "the program was started";
    }

    std::string capture() const { return folder / "a.exr"; }

    const fs::path folder = make_folder();
    std::string nap, command = GLCAST_RUN;
    static inline int count = 0;

  private:
    /// Not named by our process id: ids come again, and a test that was killed has left its folder.
    static fs::path make_folder() {
        std::string pattern = fs::temp_directory_path() / "glcast-run-test-XXXXXX";
        return mkdtemp(pattern.data()) ? pattern : throw std::runtime_error("cannot make " + pattern);
    }
};

} // namespace glcast::test
