// libglcast.so, of both widths: where they are, and what LD_PRELOAD has to say so that each process takes its
// own.
#pragma once
#include <filesystem>
#include <string>

namespace glcast::run {

struct Library {
    std::filesystem::path file;  ///< for programs of our own width; empty: not found
    std::filesystem::path other; ///< for 32-bit programs, where ours is for 64; empty: not there

    /// What LD_PRELOAD names. With both there it is PREFIX/$LIB/glcast/libglcast.so: the loader of each
    /// process puts its own folder for $LIB (ld.so(8)), so that a script and the 32-bit program that it
    /// starts both find theirs. Where the path has a space or a colon, at which the loader splits, or a
    /// dollar, it goes through a link in `scratch`.
    std::string preload(const std::filesystem::path& scratch) const;

    std::filesystem::path prefix; ///< of both, when they lie as PREFIX/$LIB/glcast/libglcast.so
};

/// GLCAST_LIBRARY (which may have $LIB in it), else beside this program, in the build tree or in the library
/// folder of the install.
Library find_library();

} // namespace glcast::run
