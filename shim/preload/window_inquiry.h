// What the X server says of windows, without ever waiting long for it.
//
// A program may hold the server for itself (XGrabServer) while it swaps: it then answers nobody else, not
// even a new connection, until the program, which waits for us, lets go of it. So it is asked on a thread of
// our own, and the program's thread waits for that a moment only. An answer that comes later is there at the
// next question.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace glcast::preload {

struct WindowFacts {
    bool viewable = false; ///< on the screen
    std::string title;     ///< its own, or of the window that it is in
};
using WindowAnswers = std::map<std::uint32_t, WindowFacts>; ///< by the X server's names

/// Not for use by several threads at a time.
class WindowInquiry {
  public:
    /// All that is known by now of `names` and of others; `server` as in $DISPLAY. Waits a moment, and after
    /// the first time that no answer came in it, not at all any more.
    WindowAnswers ask(const std::string& server, std::vector<std::uint32_t> names);
    /// How many questions were not answered in time.
    long unanswered() const { return late; }

  private:
    struct Question;
    std::shared_ptr<Question> open; ///< not answered when last looked at
    WindowAnswers known;
    long late = 0;
};

} // namespace glcast::preload
