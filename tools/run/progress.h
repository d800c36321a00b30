// A cast that takes long, on the terminal of glcast-run.
#pragma once
#include <string>

#include "tools/run/status.h"

namespace glcast::run {

/// That it will take long stands in a line of its own. How far it is stands in one that is written over, on a
/// terminal alone.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const Seen& seen);
    void clear();

  private:
    const bool is_terminal;
    bool has_warned = false;
    std::string shown;
};

} // namespace glcast::run
