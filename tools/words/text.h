// Words that are safe on a terminal and in a shell.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace glcast {

/// For a terminal: control characters and bytes that are no UTF-8 as \x1b, so that a name in a file can
/// neither move the cursor nor begin a line of its own.
std::string printable(std::string_view text);

/// For a shell: quoted where it must be.
std::string shell_word(const std::string& text);

/// The name that somebody who wrote `word` meant: the nearest by letters changed, put in, left out or swapped
/// (Damerau 1964), at most a third of them. Empty where none is near.
std::string nearest(std::string_view word, std::span<const std::string> names);

/// "a, b and c"
std::string enumeration(std::span<const std::string> names, const char* last = " and ");

/// "1 triangle", "12,345 triangles"
std::string counted(std::size_t count, const std::string& one, const std::string& many = "");

} // namespace glcast
