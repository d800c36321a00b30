#include "tools/io/input_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace glcast {

namespace {

[[noreturn]] void refuse(const char* why) { throw std::runtime_error(why); }

} // namespace

InputFile::InputFile(const std::filesystem::path& path)
    : descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    struct stat about {};
    const bool known = descriptor >= 0 && fstat(descriptor, &about) == 0;
    const char* why = !known                    ? std::strerror(errno)
                      : S_ISDIR(about.st_mode)  ? "is a folder"
                      : !S_ISREG(about.st_mode) ? "is no regular file"
                                                : nullptr;
    if (why) {
        if (descriptor >= 0) close(descriptor);
        refuse(why);
    }
    bytes = std::uint64_t(about.st_size);
}

InputFile::~InputFile() { close(descriptor); }

std::vector<char> InputFile::read(std::uint64_t offset, std::uint64_t count) const {
    if (offset > bytes || count > bytes - offset) refuse("the file is truncated");
    std::vector<char> data(count);
    for (std::uint64_t have = 0; have < count;) {
        const ssize_t got = pread(descriptor, data.data() + have, count - have, off_t(offset + have));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) refuse(std::strerror(errno));
        if (got == 0) refuse("the file is truncated"); // while it is read
        have += std::uint64_t(got);
    }
    return data;
}

} // namespace glcast
