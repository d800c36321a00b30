#include "capture/key_names.h"

#include <signal.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

namespace glcast {
namespace {

// From X11/keysymdef.h; letters, digits and F keys are reckoned.
struct Key {
    const char* name;
    std::uint32_t symbol;
};
constexpr Key keys[] = {
    {"space", 0x20},       {"Return", 0xff0d},  {"Tab", 0xff09},     {"Escape", 0xff1b},
    {"BackSpace", 0xff08}, {"Delete", 0xffff},  {"Insert", 0xff63},  {"Home", 0xff50},
    {"End", 0xff57},       {"Prior", 0xff55},   {"Page_Up", 0xff55}, {"Next", 0xff56},
    {"Page_Down", 0xff56}, {"Left", 0xff51},    {"Up", 0xff52},      {"Right", 0xff53},
    {"Down", 0xff54},      {"Print", 0xff61},   {"Pause", 0xff13},   {"Scroll_Lock", 0xff14},
    {"Menu", 0xff67},      {"Num_Lock", 0xff7f}};
constexpr int last_f_key = 35;

/// sigabbrev_np, which came with glibc 2.32.
struct Signal {
    const char* name;
    int number;
};
constexpr Signal signals[] = {
    {"HUP", SIGHUP},     {"INT", SIGINT},       {"QUIT", SIGQUIT}, {"ILL", SIGILL},       {"TRAP", SIGTRAP},
    {"ABRT", SIGABRT},   {"BUS", SIGBUS},       {"FPE", SIGFPE},   {"KILL", SIGKILL},     {"USR1", SIGUSR1},
    {"SEGV", SIGSEGV},   {"USR2", SIGUSR2},     {"PIPE", SIGPIPE}, {"ALRM", SIGALRM},     {"TERM", SIGTERM},
    {"CHLD", SIGCHLD},   {"CONT", SIGCONT},     {"STOP", SIGSTOP}, {"TSTP", SIGTSTP},     {"TTIN", SIGTTIN},
    {"TTOU", SIGTTOU},   {"URG", SIGURG},       {"XCPU", SIGXCPU}, {"XFSZ", SIGXFSZ},     {"PROF", SIGPROF},
    {"WINCH", SIGWINCH}, {"VTALRM", SIGVTALRM}, {"POLL", SIGPOLL}, {"STKFLT", SIGSTKFLT}, {"PWR", SIGPWR},
    {"SYS", SIGSYS}};

int whole_number(const std::string& text) {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? number : -1;
}

/// What ends the program, or comes from its own faults.
bool is_unfit(int number) {
    constexpr int unfit[] = {SIGKILL, SIGSTOP, SIGSEGV, SIGBUS, SIGILL,  SIGFPE,  SIGABRT,
                             SIGTRAP, SIGSYS,  SIGTERM, SIGINT, SIGQUIT, SIGCHLD, SIGPIPE};
    return std::find(std::begin(unfit), std::end(unfit), number) != std::end(unfit);
}

} // namespace

std::uint32_t key_symbol(const std::string& name) {
    if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
        return static_cast<std::uint32_t>(std::tolower(static_cast<unsigned char>(name[0])));
    if (name.size() > 1 && (name[0] == 'F' || name[0] == 'f')) {
        const int number = whole_number(name.substr(1));
        return number >= 1 && number <= last_f_key ? 0xffbd + static_cast<std::uint32_t>(number) : 0;
    }
    for (const Key& key : keys)
        if (name == key.name) return key.symbol;
    return 0;
}

int signal_number(const std::string& name) {
    const std::string bare = name.starts_with("SIG") ? name.substr(3) : name;
    if (bare.starts_with("RTMIN")) {
        const int above = bare.size() == 5 ? 0 : bare[5] == '+' ? whole_number(bare.substr(6)) : -1;
        return above >= 0 && SIGRTMIN + above <= SIGRTMAX ? SIGRTMIN + above : 0;
    }
    for (const Signal& known : signals)
        if (bare == known.name) return is_unfit(known.number) ? 0 : known.number;
    return 0;
}

} // namespace glcast
