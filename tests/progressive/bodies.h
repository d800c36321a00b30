// Meshes to refine, with logs that are not glcast's own, and what it means that two are the same.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/progressive/shortest_edge.h"

namespace glcast::test {

struct LoggedBody {
    std::string name;
    Mesh mesh;
    CollapseLog log;
};

/// Spheres, tori, teapot with its boundaries, grids of random bars, far away and tiny ones; with colours,
/// normals, both or neither.
std::vector<LoggedBody> logged_bodies();

/// One, small: a torus with colours and normals.
LoggedBody small_body();

/// Bit for bit.
testing::AssertionResult same(const Mesh& a, const Mesh& b);

} // namespace glcast::test
