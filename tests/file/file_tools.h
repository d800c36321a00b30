// Folders that clean up after themselves, files as strings, and commands with their output.
#pragma once
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace glcast::samples {

class Folder {
  public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "glcast-test-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        where = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(where, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return where / name; }
    const std::filesystem::path& path() const { return where; }
    std::vector<std::string> names() const { ///< sorted
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(where))
            all.push_back(entry.path().filename());
        std::sort(all.begin(), all.end());
        return all;
    }

  private:
    std::filesystem::path where;
};

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Ran {
    int status = -1;
    std::string output;
};

/// By the shell, at most a minute; standard output alone unless the command redirects.
inline Ran run(const std::string& command) {
    Ran ran;
    FILE* pipe = popen(("exec 2>&1; timeout 60 sh -c '" + command + "'").c_str(), "r");
    if (!pipe) return ran;
    char buffer[4096];
    for (std::size_t got; (got = fread(buffer, 1, sizeof buffer, pipe)) > 0;) ran.output.append(buffer, got);
    const int status = pclose(pipe);
    ran.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ran;
}

} // namespace glcast::samples
