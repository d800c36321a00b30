#include "tools/run/checks.h"

#include <elf.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "capture/output_file.h"

namespace glcast::run {
namespace fs = std::filesystem;
namespace {

std::string reason(int error) { return std::strerror(error); }

bool gains_privileges(const fs::path& program, const struct stat& status) {
    const bool other_user = (status.st_mode & S_ISUID) != 0 && status.st_uid != geteuid();
    const bool other_group = (status.st_mode & S_ISGID) != 0 && status.st_gid != getegid();
    return other_user || other_group || getxattr(program.c_str(), "security.capability", nullptr, 0) > 0;
}

/// The file's interpreter when it is a script.
std::optional<std::string> script_interpreter(std::ifstream& file) {
    std::string line;
    file.seekg(0);
    std::getline(file, line);
    if (!line.starts_with("#!")) {
        return std::nullopt;
    }
    std::istringstream words(line.substr(2));
    std::string interpreter;
    words >> interpreter;
    return interpreter;
}

template <class Header, class Segment> bool has_loader(std::ifstream& file) {
    Header header{};
    file.clear();
    file.seekg(0);
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    for (int i = 0; file && i < header.e_phnum; ++i) {
        Segment segment{};
        file.seekg(static_cast<std::streamoff>(header.e_phoff + std::uint64_t(i) * header.e_phentsize));
        if (file.read(reinterpret_cast<char*>(&segment), sizeof segment) && segment.p_type == PT_INTERP)
            return true;
    }
    return false;
}

/// Of our machine's kind: a program, or a script's interpreter.
Elf32_Ehdr read_ident(std::istream& file) {
    Elf32_Ehdr header{}; // e_machine lies at one place in both widths
    if (!file.read(reinterpret_cast<char*>(&header), sizeof header) ||
        std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
        return {};
    return header;
}

std::string check_elf(std::ifstream& file, const std::string& name, const Library& library) {
    file.clear();
    file.seekg(0);
    const Elf32_Ehdr header = read_ident(file);
    if (header.e_ident[EI_MAG0] == 0)
        return name + " is neither a program nor a script that names its interpreter";
    std::ifstream self("/proc/self/exe", std::ios::binary);
    const Elf32_Ehdr ours = read_ident(self);
    const bool same =
        header.e_ident[EI_CLASS] == ours.e_ident[EI_CLASS] && header.e_machine == ours.e_machine;
    const bool smaller = header.e_machine == EM_386 && ours.e_machine == EM_X86_64;
    if (!same && !smaller)
        return name +
               " is for another kind of processor than this glcast, so the library cannot be preloaded";
    if (smaller && library.other.empty())
        return name +
               " is a 32-bit program, and the library for those is not there "
               "(lib/i386-linux-gnu/glcast/libglcast.so): "
               "install the package libglcast0:i386, or g++-multilib and lib32z1-dev before glcast is built";
    if (header.e_ident[EI_CLASS] == ELFCLASS32 ? has_loader<Elf32_Ehdr, Elf32_Phdr>(file)
                                               : has_loader<Elf64_Ehdr, Elf64_Phdr>(file))
        return {};
    return name +
           " is linked statically: it has no loader that could preload a library, so it cannot be cast";
}

} // namespace

std::string check_output(const fs::path& file) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) {
        return "cannot write " + file.string() + ": it is a folder";
    }
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
        return "cannot write " + file.string() + ": it is no regular file";
    }
    if (fs::exists(file, ignored) && access(file.c_str(), W_OK) != 0) {
        return "cannot write " + file.string() + ": " + reason(errno);
    }
    // Permission bits do not tell the truth to root nor on a read-only file system, so try: without a name
    // where that can be done, so that nothing is left when we are killed meanwhile.
    return why_not_writable(file);
}

std::string check_program(const fs::path& program, const Library& library) {
    struct stat status {};
    if (stat(program.c_str(), &status) != 0) {
        return "cannot run " + program.string() + ": " + reason(errno);
    }
    if (!S_ISREG(status.st_mode) || access(program.c_str(), X_OK) != 0) {
        return "cannot run " + program.string() + ": it is not a program that you may run";
    }
    if (gains_privileges(program, status)) {
        return program.string() + " is setuid, setgid or has capabilities: the loader ignores preloads "
                                  "there, so it cannot be cast";
    }
    std::ifstream file(program, std::ios::binary);
    if (!file) {
        return {}; // may be run but not read: leave it to the loader
    }
    const auto interpreter = script_interpreter(file);
    if (interpreter && *interpreter != program) {
        return check_program(*interpreter, library);
    }
    return check_elf(file, program.string(), library);
}

fs::path find_program(const std::string& name) {
    if (name.find('/') != std::string::npos) {
        return name;
    }
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
        std::error_code ignored;
        if (fs::is_regular_file(candidate, ignored) && access(candidate.c_str(), X_OK) == 0) {
            return candidate;
        }
    }
    return {};
}

} // namespace glcast::run
