#include "shim/preload/wine.h"

#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace glcast::preload {
namespace {

/// Wine 8.
constexpr const char* helpers[] = {"conhost.exe",    "explorer.exe",       "iexplore.exe", "plugplay.exe",
                                   "rpcss.exe",      "rundll32.exe",       "services.exe", "start.exe",
                                   "svchost.exe",    "tabtip.exe",         "wineboot.exe", "winedbg.exe",
                                   "winedevice.exe", "winemenubuilder.exe"};

std::string own_file() {
    char path[4096];
    const ssize_t size = readlink("/proc/self/exe", path, sizeof path);
    const std::string file(path, size > 0 ? std::size_t(size) : 0);
    return file.substr(file.rfind('/') + 1);
}

} // namespace

bool is_wine() {
    const std::string file = own_file();
    for (const char* loader : {"wine", "wine64", "wine-preloader", "wine64-preloader"})
        if (file == loader) return true;
    return false;
}

std::string windows_program() {
    std::string command;
    std::getline(std::ifstream("/proc/self/cmdline", std::ios::binary), command, '\0');
    return command.substr(command.find_last_of("/\\:") + 1);
}

bool is_wine_helper() {
    if (own_file().starts_with("wineserver")) return true;
    if (!is_wine()) return false;
    const std::string program = windows_program();
    return std::any_of(std::begin(helpers), std::end(helpers),
                       [&](const char* helper) { return strcasecmp(program.c_str(), helper) == 0; });
}

} // namespace glcast::preload
