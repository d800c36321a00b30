// A ball that is red towards +x and blue towards -x: what one sees tells from where.
#pragma once
#include <cmath>
#include <string>

#include "tools/io/level_set.h"
#include "tools/io/mesh_io.h"

namespace glcast::samples {

/// About the origin: `around` columns, half as many rings, 2 around (around / 2 - 1) triangles.
inline Mesh ball(double radius, std::uint32_t around) {
    Mesh m;
    const std::uint32_t rings = around / 2;
    const auto add = [&](const glm::dvec3& n) {
        m.positions.push_back(n * radius);
        m.normals.emplace_back(n);
        m.colours.push_back(n.x > 0 ? glm::vec3(0.9f, 0.1f, 0.1f) : glm::vec3(0.1f, 0.1f, 0.9f));
    };
    add({0, -1, 0});
    for (std::uint32_t r = 1; r < rings; ++r)
        for (std::uint32_t k = 0; k < around; ++k) {
            const double a = M_PI * r / rings, b = 2 * M_PI * (k + 0.5) / around;
            add({std::sin(a) * std::cos(b), -std::cos(a), -std::sin(a) * std::sin(b)});
        }
    add({0, 1, 0});
    const auto at = [&](std::uint32_t r, std::uint32_t k) { return 1 + (r - 1) * around + k % around; };
    const std::uint32_t top = std::uint32_t(m.positions.size()) - 1;
    for (std::uint32_t k = 0; k < around; ++k) {
        m.triangles.push_back({0, at(1, k + 1), at(1, k)});
        m.triangles.push_back({top, at(rings - 1, k), at(rings - 1, k + 1)});
        for (std::uint32_t r = 1; r + 1 < rings; ++r) {
            m.triangles.push_back({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
            m.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
        }
    }
    return m;
}

/// Levels of 16128, 960 and 224 triangles, a file each or all in one; the last is too large by 0.2 everywhere
/// and has a name that is no name.
inline void write_balls(const std::string& path, bool one_file = false) {
    std::vector<Level> levels(3);
    levels[0].mesh = ball(1, 128), levels[0].name = "level 0";
    levels[1].mesh = ball(1, 32), levels[1].name = "level 1";
    levels[2].mesh = ball(1.2, 16), levels[2].name = "</script><script>throw 1</script>";
    levels[2].error.mean = levels[2].error.max = 0.2;
    if (!one_file) join_as_set(levels);
    write_levels(path, levels, {.one_file = one_file});
}

} // namespace glcast::samples
