#include "shim/preload/join_parts.h"

namespace glcast::preload {
namespace {

constexpr std::size_t long_part = 256; ///< elements

void append(std::vector<GLuint>& elements, const record::DrawParts::Part& part) {
    for (std::uint32_t i = 0; i < part.count; ++i) elements.push_back(part.first + i);
}

void repeat(std::vector<GLuint>& elements, GLuint element, std::size_t times) {
    elements.insert(elements.end(), times, element);
}

} // namespace

bool are_to_be_joined(const std::vector<record::DrawParts::Part>& parts) {
    std::size_t all = 0;
    for (const auto& part : parts) all += part.count;
    return parts.size() > 1 && all < parts.size() * long_part;
}

std::vector<GLuint> join_parts(GLenum mode, const std::vector<record::DrawParts::Part>& parts) {
    const bool strip = mode == GL_TRIANGLE_STRIP || mode == GL_QUAD_STRIP;
    std::vector<GLuint> elements;
    for (const auto& part : parts) {
        if (strip && !elements.empty()) {
            // a b | b b c c | c d: whole pairs, for both kinds of strips.
            repeat(elements, elements.back(), 2 + elements.size() % 2);
            repeat(elements, part.first, 2);
        }
        append(elements, part);
    }
    return elements;
}

} // namespace glcast::preload
