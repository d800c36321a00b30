#include "capture/output_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>

namespace glcast {
namespace {

constexpr mode_t file_mode = 0666; // less the user's umask

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

/// Short, so that a long target name does not make this one too long; unique by process and counter.
std::string temporary_name(const std::string& path) {
    static std::atomic<unsigned> counter{0};
    return folder_of(path) + "/.glcast-" + std::to_string(getpid()) + "-" + std::to_string(++counter) +
           ".tmp";
}

// Plain data: the preloaded library has no static constructors.
constinit std::mutex commits; ///< held while files change their names, and for `first_open`
constinit OutputFile* first_open = nullptr;

std::string descriptor_path(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// A name for an O_TMPFILE. False where something has it.
bool link_to(int descriptor, const std::string& path) {
    const std::string from = descriptor_path(descriptor);
    return linkat(AT_FDCWD, from.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

} // namespace

OutputFile::OutputFile(std::string target) : path(std::move(target)) {
    const std::lock_guard lock(commits);
    next = first_open;
    if (next) next->previous = this;
    first_open = this;
    struct stat info {};
    if (path.empty() || path.back() == '/')
        message = "cannot write '" + path + "': not a file name";
    else if (stat(path.c_str(), &info) != 0)
        open_temporary();
    else if (S_ISDIR(info.st_mode))
        fail("cannot write", EISDIR);
    else if (!S_ISREG(info.st_mode))
        message = "cannot write '" + path + "': it is a device or a pipe, and no file";
    else if (open_temporary())
        keep_rights(info);
}

/// Whoever could not read what is replaced cannot read what comes.
void OutputFile::keep_rights(const struct stat& before) {
    mode_t mode = before.st_mode & 0777;
    struct stat now {};
    if (fstat(descriptor, &now) == 0 && (now.st_uid != before.st_uid || now.st_gid != before.st_gid) &&
        fchown(descriptor, before.st_uid, before.st_gid) != 0 &&
        fchown(descriptor, uid_t(-1), before.st_gid) != 0)
        mode &= 0707; // not for another group
    if (fchmod(descriptor, mode) != 0) fail("cannot write", errno);
}

OutputFile::~OutputFile() {
    const std::lock_guard lock(commits);
    (previous ? previous->next : first_open) = next;
    if (next) next->previous = previous;
    if (descriptor >= 0) close(descriptor);
    if (!temporary.empty()) unlink(temporary.c_str());
}

bool OutputFile::open_temporary() {
    const std::string folder = folder_of(path);
    descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, file_mode);
    if (descriptor >= 0) {
        if (access(descriptor_path(descriptor).c_str(), F_OK) == 0) return true;
        close(descriptor); // without /proc it could never be given a name
        descriptor = -1;
    }
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string name = temporary_name(path);
        descriptor = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, file_mode);
        if (descriptor >= 0) {
            temporary = name;
            return true;
        }
        if (errno != EEXIST) break;
    }
    return fail("cannot write", errno);
}

bool OutputFile::fail(const char* what, int code) {
    if (message.empty()) message = std::string(what) + " '" + path + "': " + std::strerror(code);
    return false;
}

bool OutputFile::append(const void* data, std::size_t bytes) {
    if (!write_at(end, data, bytes)) return false;
    end += bytes;
    return true;
}

bool OutputFile::write_at(std::uint64_t offset, const void* data, std::size_t bytes) {
    if (!message.empty()) return false;
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = pwrite(descriptor, from, bytes, static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return fail("cannot write", written < 0 ? errno : EIO);
        from += written;
        offset += static_cast<std::uint64_t>(written);
        bytes -= static_cast<std::size_t>(written);
    }
    return true;
}

bool OutputFile::skip_to(std::uint64_t offset) {
    if (!message.empty()) return false;
    end = offset;
    return true;
}

/// Gives an O_TMPFILE its temporary name; rename() then replaces what may be at the target, which link()
/// cannot.
bool OutputFile::name_unnamed() {
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string name = temporary_name(path);
        if (link_to(descriptor, name)) {
            temporary = name;
            return true;
        }
        if (errno != EEXIST) break;
    }
    return fail("cannot write", errno);
}

bool OutputFile::commit() {
    const std::lock_guard lock(commits);
    return put_in_place();
}

OutputFile* OutputFile::commit_all(std::span<OutputFile* const> files) {
    const std::lock_guard lock(commits);
    for (OutputFile* file : files)
        if (!file->put_in_place()) return file;
    return nullptr;
}

void discard_unfinished_files() {
    commits.lock(); // for good
    for (const OutputFile* file = first_open; file; file = file->next)
        if (!file->temporary.empty()) unlink(file->temporary.c_str());
}

bool OutputFile::put_in_place() {
    if (!message.empty()) return false;
    if (descriptor < 0) return fail("cannot write", EBADF);
    const bool is_linked =
        temporary.empty() && link_to(descriptor, path); // in one step: a kill leaves nothing
    if (!is_linked && temporary.empty() && !name_unnamed()) return false;
    const int closed = close(descriptor); // network file systems tell here that the disk is full
    descriptor = -1;
    if (closed != 0) {
        fail("cannot write", errno);
        if (is_linked) unlink(path.c_str());
        return false;
    }
    if (is_linked) return true;
    if (rename(temporary.c_str(), path.c_str()) != 0) return fail("cannot write", errno);
    temporary.clear();
    return true;
}

std::string why_not_writable(const std::string& path) { return OutputFile(path).error(); }

} // namespace glcast
