// Writing to a descriptor out of somebody else's program: no signal of ours reaches it, its errno stays, and
// it is not cancelled in our call.
#pragma once
#include <signal.h>

#include <string_view>

namespace glcast::preload {

/// While it lives, this thread takes no signal, is not cancelled, and keeps its errno for afterwards. So a
/// handler of the program that draws cannot meet a mutex of ours, and SIGTTOU (a terminal with tostop) does
/// not stop it.
class QuietThread {
  public:
    QuietThread();
    ~QuietThread();
    QuietThread(const QuietThread&) = delete;
    QuietThread& operator=(const QuietThread&) = delete;

  private:
    sigset_t before;
    int cancel_state = 0, error = 0;
};

/// In a QuietThread. One write of `text` as `how(descriptor, text)` does it, which returns as write(2). The
/// SIGPIPE or SIGXFSZ that it raises is taken off. Null when all is written, else why not; half a line may be
/// there, then.
const char* write_quietly(int descriptor, std::string_view text,
                          ssize_t (*how)(int descriptor, std::string_view text));

/// write(2).
ssize_t write_once(int descriptor, std::string_view text);

/// Descriptors 0 to 2 are the program's to choose, also when it has closed them: `descriptor` of ours, moved
/// out of the way where it is one of them. -1 where that fails; `descriptor` is closed then.
int above_standard(int descriptor);

} // namespace glcast::preload
