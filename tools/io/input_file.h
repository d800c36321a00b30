// A file that is read at chosen places: a regular file, and nothing else.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace glcast {

/// Never waits: a FIFO or a device is refused before a byte of it is asked for.
class InputFile {
  public:
    /// Throws std::runtime_error, without the file's name: there is none, it is a folder, no regular file, …
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::uint64_t size() const { return bytes; } ///< when it was opened

    /// From any thread. Throws std::runtime_error when the file ends before; allocates nothing then, so that
    /// a length out of a file costs no memory that the file does not back.
    std::vector<char> read(std::uint64_t offset, std::uint64_t count) const;

  private:
    int descriptor = -1;
    std::uint64_t bytes = 0;
};

} // namespace glcast
