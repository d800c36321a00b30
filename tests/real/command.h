// Running a command as a person would, with a limit.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace glcast::test {

struct CommandResult {
    int exit_code = -1; ///< -signal when a signal ended it
    bool timed_out = false;
    std::string out, err;
};

/// Runs `command` (found along PATH) with `environment` on top of ours, and kills it with its session at the
/// limit.
CommandResult run_command(const std::vector<std::string>& command, double limit_seconds,
                          const std::vector<std::pair<std::string, std::string>>& environment = {});

} // namespace glcast::test
