// Parts of draws in one list of elements: the triangles of the parts, turned as before, and none besides.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "shim/preload/join_parts.h"

namespace glcast::preload {
namespace {

using Triangle = std::array<GLuint, 3>;
using Parts = std::vector<record::DrawParts::Part>;

/// Those with an area, from the least corner on.
void add(std::vector<Triangle>& to, Triangle t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    to.push_back(t);
}

std::vector<Triangle> triangles(GLenum mode, const std::vector<GLuint>& e) {
    std::vector<Triangle> all;
    if (mode == GL_TRIANGLES)
        for (std::size_t i = 0; i + 2 < e.size(); i += 3) add(all, {e[i], e[i + 1], e[i + 2]});
    if (mode == GL_TRIANGLE_STRIP)
        for (std::size_t i = 0; i + 2 < e.size(); ++i) add(all, {e[i + i % 2], e[i + 1 - i % 2], e[i + 2]});
    if (mode == GL_QUAD_STRIP)
        for (std::size_t i = 0; i + 3 < e.size(); i += 2)
            add(all, {e[i], e[i + 1], e[i + 3]}), add(all, {e[i], e[i + 3], e[i + 2]});
    return all;
}

std::vector<Triangle> one_by_one(GLenum mode, const Parts& parts) {
    std::vector<Triangle> all;
    for (const auto& part : parts) {
        std::vector<GLuint> elements(part.count);
        for (GLuint i = 0; i < part.count; ++i) elements[i] = part.first + i;
        for (const Triangle& t : triangles(mode, elements)) all.push_back(t);
    }
    return all;
}

TEST(Join, keeps_the_triangles_of_all_parts_and_how_they_turn) {
    const Parts triangles_of{{0, 3}, {9, 6}, {30, 3}}, strips{{0, 4}, {6, 5}, {20, 3}, {40, 4}},
        quads{{0, 4}, {10, 6}, {20, 4}};
    for (const auto& [mode, parts] :
         {std::pair(GL_TRIANGLES, triangles_of), {GL_TRIANGLE_STRIP, strips}, {GL_QUAD_STRIP, quads}}) {
        const GLenum of = static_cast<GLenum>(mode);
        EXPECT_EQ(triangles(of, join_parts(of, parts)), one_by_one(of, parts)) << mode;
    }
}

TEST(Join, takes_points_as_they_are) {
    EXPECT_EQ(join_parts(GL_POINTS, {{2, 1}, {5, 2}}), (std::vector<GLuint>{2, 5, 6}));
}

TEST(Join, is_for_short_parts_alone) {
    EXPECT_FALSE(are_to_be_joined({{0, 3}}));
    EXPECT_TRUE(are_to_be_joined({{0, 3}, {9, 3}}));
    EXPECT_FALSE(are_to_be_joined({{0, 3000}, {9000, 3000}}));
}

} // namespace
} // namespace glcast::preload
