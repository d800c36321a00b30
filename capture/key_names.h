// Names of keys and signals, as options give them.
#pragma once
#include <cstdint>
#include <string>

namespace glcast {

/// X keysym of "F12", "a", "7", "Print", ...; 0 when there is no such key.
std::uint32_t key_symbol(const std::string& name);

/// Number of "USR1", "SIGUSR1", "RTMIN+2"; 0 when there is none, or when it cannot be caught or means the end
/// of the program.
int signal_number(const std::string& name);

} // namespace glcast
