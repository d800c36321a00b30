#include "tools/io/beside.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace glcast::format {
namespace {

struct Descriptor {
    int number;
    explicit Descriptor(int number) : number(number) {}
    ~Descriptor() {
        if (number >= 0) close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
};

/// The kernel refuses what leads out of the folder (Linux 5.6); before, only plain names without links are opened.
int open_below(int folder, const std::string& name) {
    open_how how{};
    how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    const long opened = syscall(SYS_openat2, folder, name.c_str(), &how, sizeof how);
    if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(opened);
    if (name.find('/') != name.npos || name == "..") return -1;
    return openat(folder, name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW);
}

std::optional<std::string> contents(int file, std::size_t most) {
    struct stat about {};
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || static_cast<std::size_t>(about.st_size) > most)
        return std::nullopt;
    std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
    std::size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t got = read(file, bytes.data() + have, bytes.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return std::nullopt;
        have += static_cast<std::size_t>(got);
    }
    return bytes;
}

} // namespace

std::optional<std::string> read_beside(const std::filesystem::path& mesh, std::string_view name, std::size_t most) {
    std::string wanted(name);
    std::replace(wanted.begin(), wanted.end(), '\\', '/'); // as Windows writes it
    if (wanted.empty() || wanted.find('\0') != wanted.npos) return std::nullopt;
    const std::filesystem::path parent = mesh.has_parent_path() ? mesh.parent_path() : ".";
    const Descriptor folder(open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (folder.number < 0) return std::nullopt;
    for (const std::string& tried : {wanted, wanted.substr(wanted.rfind('/') + 1)}) {
        if (tried.empty()) continue;
        const Descriptor file(open_below(folder.number, tried));
        if (file.number < 0) continue;
        if (auto bytes = contents(file.number, most)) return bytes;
    }
    return std::nullopt;
}

} // namespace glcast::format
