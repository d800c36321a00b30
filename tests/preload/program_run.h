// Running programs with libglcast.so preloaded.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/xvfb.h"
#include "tools/io/capture_reader.h"

namespace glcast::test {

/// The X server of this test program.
const Xvfb& x_server();

using Environment = std::map<std::string, std::string>;

/// A program under the X server, with software GL; the shim is preloaded when `preload`.
Outcome run_program(const std::vector<std::string>& arguments, const Environment& environment, bool preload);

/// What a fixture program left behind.
struct FixtureRun {
    Outcome outcome;
    std::string pixels, errors, state; ///< its own files
    std::optional<Capture> capture;    ///< read back, when one was written
};

/// `arguments`: program and options; the options for the fixture's own files are added.
FixtureRun run_fixture(std::vector<std::string> arguments, const Environment& environment, bool preload);

/// With GLCAST_OUT set to a file of its own, n = 64.
FixtureRun cast_fixture(const std::vector<std::string>& arguments, const Environment& environment = {});

/// Any program, and the capture that it left, with GLCAST_OUT set to a file of its own.
struct CastRun {
    Outcome outcome;
    std::optional<Capture> capture;
};
CastRun cast_program(const std::vector<std::string>& command, int n, Environment environment = {});

/// Lines of stderr that begin with "glcast: ", without that.
std::vector<std::string> glcast_lines(const Outcome& outcome);

/// Of a body that no line along z meets more than once: what lies between the first and the last hits.
double volume(const Capture& capture);

/// Largest difference of two captures: depth where both are covered, normals likewise, pixels covered by one
/// alone.
struct CaptureDifference {
    double depth = 0, normal = 0, colour = 0;
    long coverage = 0, covered = 0;
};
CaptureDifference compare(const Capture& a, const Capture& b);

} // namespace glcast::test
