// A file that appears complete or not at all.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

struct stat;

namespace glcast {

/// Written without a name where the file system can do that (O_TMPFILE), else under a temporary name beside
/// the target; commit() puts it in place by rename. Without commit() nothing is left, and a file that was
/// there stays as it was; what replaces it has its rights. A link is replaced, and its target left alone. All
/// functions return false on failure, with one line in error(). Throws nothing but std::bad_alloc.
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
    /// All or, on an interrupt before it, none. The first that failed; null when all are in place.
    static OutputFile* commit_all(std::span<OutputFile* const> files);

    std::uint64_t position() const { return end; }
    const std::string& error() const { return message; }

  private:
    friend void discard_unfinished_files();
    bool put_in_place();
    bool open_temporary();
    void keep_rights(const struct stat& before);
    bool name_unnamed();
    bool fail(const char* what, int code);

    std::string path, temporary; ///< `temporary` is empty while the file has no name
    std::string message;
    std::uint64_t end = 0;
    int descriptor = -1;
    OutputFile *next = nullptr, *previous = nullptr; ///< all that are open, for discard_unfinished_files
};

/// For a program that ends by a signal: waits for commits under way, removes every other temporary, and lets
/// no commit happen afterwards (it would wait for ever, so call _exit next). From a thread, not from a signal
/// handler.
void discard_unfinished_files();

/// Can a file be made at `path`? Empty when yes, else why not, one line. Leaves nothing behind.
std::string why_not_writable(const std::string& path);

} // namespace glcast
