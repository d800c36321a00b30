// The glcast command (GLCAST_COMMAND), run as a user runs it.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/file/file_tools.h"

namespace glcast::samples {

inline Ran glcast_run(const std::string& arguments) { return run(GLCAST_COMMAND " " + arguments); }

/// Standard output alone, as JSON.
inline nlohmann::json json_of(const std::string& arguments) {
    const Ran ran = glcast_run(arguments + " --json 2>/dev/null");
    EXPECT_EQ(ran.status, 0) << ran.output;
    return nlohmann::json::parse(ran.output);
}

/// A refusal: one line, in it `part`.
inline void expect_one_line(const Ran& ran, int status, const std::string& part) {
    EXPECT_EQ(ran.status, status) << ran.output;
    EXPECT_TRUE(ran.output.starts_with("glcast: ")) << ran.output;
    EXPECT_EQ(std::count(ran.output.begin(), ran.output.end(), '\n'), 1) << ran.output;
    EXPECT_NE(ran.output.find(part), std::string::npos) << ran.output;
}

} // namespace glcast::samples
