// A file that appears complete or not at all.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace glcast {

/// Written without a name where the file system can do that (O_TMPFILE), else under a temporary name beside
/// the target; commit() puts it in place by rename. Without commit() nothing is left, and a file that was
/// there stays as it was. All functions return false on failure, with one line in error(). Throws nothing but
/// std::bad_alloc.
class OutputFile {
  public:
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    bool append(const void* data, std::size_t bytes);
    /// Overwrite or fill what lies at `offset`; the position of append() stays.
    bool write_at(std::uint64_t offset, const void* data, std::size_t bytes);
    /// Leave a gap: the next append() goes to `offset`.
    bool skip_to(std::uint64_t offset);
    bool commit();

    std::uint64_t position() const { return end; }
    const std::string& error() const { return message; }

  private:
    bool open_temporary();
    bool name_unnamed();
    bool fail(const char* what, int code);

    std::string path, temporary; ///< `temporary` is empty while the file has no name
    std::string message;
    std::uint64_t end = 0;
    int descriptor = -1;
};

/// Can a file be made at `path`? Empty when yes, else why not, one line. Leaves nothing behind.
std::string why_not_writable(const std::string& path);

} // namespace glcast
