// A torus under a texture that goes once round it both ways: seams along a circle of either kind.
#pragma once
#include <tuple>

#include "tests/file/sample_meshes.h"
#include "tools/mesh/level.h"

namespace glcast::samples {

inline glm::vec3 torus_colour(double u, double v) {
    return {0.5 + 0.5 * std::sin(2 * M_PI * u), 0.5 + 0.5 * std::cos(2 * M_PI * v), 0.25};
}

/// `tilt`: degrees that the normal map leans towards growing x of the picture.
inline Texture torus_texture(std::uint32_t u, std::uint32_t v, int size, double tilt = 0) {
    Texture texture;
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
        const double a = 2 * M_PI * i / u;
        return std::pair(glm::vec2(double(i) / u, double(j) / v),
                         glm::vec4(-std::sin(a), std::cos(a), 0, -1));
    };
    for (std::uint32_t i = 0; i < u; ++i)
        for (std::uint32_t j = 0; j < v; ++j)
            for (const auto& corners :
                 {std::array<std::array<std::uint32_t, 2>, 3>{{{0, 0}, {1, 0}, {1, 1}}},
                  std::array<std::array<std::uint32_t, 2>, 3>{{{0, 0}, {1, 1}, {0, 1}}}}) {
                texture.coordinates.emplace_back();
                texture.tangents.emplace_back();
                std::array<glm::vec2, 3> at;
                for (int k = 0; k < 3; ++k)
                    std::tie(at[k], texture.tangents.back()[k]) =
                        corner(i + corners[k][0], j + corners[k][1]);
                texture.coordinates.back() = at;
            }
    texture.colour.width = texture.colour.height = texture.normal.width = texture.normal.height = size;
    const auto byte = [](double x) { return std::uint8_t(std::lround(x * 255)); };
    const double lean = tilt * M_PI / 180;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec3 c = torus_colour((x + 0.5) / size, (y + 0.5) / size);
            for (int k = 0; k < 3; ++k) texture.colour.rgb.push_back(byte(c[k]));
            for (const double n : {std::sin(lean), 0.0, std::cos(lean)})
                texture.normal.rgb.push_back(byte((n + 1) / 2));
        }
    return texture;
}

inline Level textured_torus(std::uint32_t u, std::uint32_t v, int size = 64, const char* name = "level 0") {
    Level level{torus(u, v), name, {}, 0.125, torus_texture(u, v, size)};
    for (std::uint32_t i = 0; i < u; ++i)
        for (std::uint32_t j = 0; j < v; ++j)
            level.mesh.colours[i * v + j] = torus_colour(double(i) / u, double(j) / v);
    return level;
}

} // namespace glcast::samples
