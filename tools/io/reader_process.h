// Runs a reader that is not ours in a process of its own.
#pragma once
#include <functional>
#include <string>

namespace glcast::format {

/// What `read` returns, run in a child process that opens no files, writes none, and ends with the parent: a crash, an assertion
/// or a file that asks for too much is a line and not the end of the program. `input`: bytes that the child
/// reads, for its limits: 256 MB and 64 times the input of memory (none under AddressSanitizer), 5 s and 1 s a megabyte of
/// processor time, five times that by the clock. Throws std::runtime_error: what `read` threw, or what became of the child.
std::string read_apart(std::size_t input, const std::function<std::string()>& read);

} // namespace glcast::format
