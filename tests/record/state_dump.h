// Everything that a program can ask a fixed-function context about, as name -> values.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::test {

using State = std::map<std::string, std::vector<double>>;

/// `client`: also what a program sets for itself: arrays, pixel store, buffer bindings.
State dump_state(const GlTable& gl, bool client);

/// The first few entries that differ, one a line.
std::string difference(const State& a, const State& b);

} // namespace glcast::test
