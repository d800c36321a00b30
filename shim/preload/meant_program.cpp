#include "shim/preload/meant_program.h"

#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace glcast::preload {
namespace {

constexpr long clock_step = 10'000'000; ///< ns: file times come from a clock that ticks so often, or oftener

/// Trivial: nothing is allocated while the program is loaded.
struct Start {
    pid_t process, parent;
    timespec time;
};
constinit Start start{};

[[gnu::constructor]] void remember_start() noexcept {
    start.process = getpid();
    start.parent = getppid();
    clock_gettime(CLOCK_REALTIME, &start.time);
}

/// Both variables that make the preload act, as this process has them, stand in the parent's environment.
bool parent_has_the_preload() {
    const char* preload = std::getenv("LD_PRELOAD");
    if (!preload) return false;
    const std::string wanted = std::string("LD_PRELOAD=") + preload;
    std::ifstream environment("/proc/" + std::to_string(start.parent) + "/environ", std::ios::binary);
    bool has_library = false, has_output = false;
    for (std::string variable; std::getline(environment, variable, '\0');) {
        has_library |= variable == wanted;
        has_output |= variable.starts_with("GLCAST_OUT=") || variable.starts_with("GLCAST_LIST=");
    }
    return has_library && has_output;
}

} // namespace

bool is_meant_program() {
    if (getpid() != start.process || getppid() != start.parent) return false;
    return !parent_has_the_preload();
}

bool written_since_start(const std::string& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) return false;
    const auto nanoseconds = [](const timespec& t) { return t.tv_sec * 1'000'000'000L + t.tv_nsec; };
    return nanoseconds(status.st_mtim) >= nanoseconds(start.time) - clock_step;
}

} // namespace glcast::preload
