// A cast holds the program up: people hear of it beforehand when it will be long, then how far it is, and can
// bound it.
#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "capture/view.h"

namespace glcast::preload {

/// What people hear of.
struct PatienceLines {
    std::function<void(const std::string& text)> slow;     ///< once: it will take long
    std::function<void(const std::string& text)> progress; ///< then, at most once a second
};

/// Looks at the clock where a cast can stop: before each time that it draws the frame.
class Patience {
  public:
    using Seconds = std::chrono::duration<double>;

    /// `most`: seconds for the whole cast; 0: no limit. `now` is the time since any moment.
    Patience(double most, PatienceLines lines, std::function<Seconds()> now = clock);

    /// Throws std::runtime_error, with one line that says what to do, when the time is over.
    void render_begins();
    void image_is_done(const View& view) { last = view, has_image = true; }

    /// Why the cast was given up; empty: it was not. What is drawn to find the box swallows the exception.
    const std::string& over() const { return why_over; }

    static Seconds clock();

  private:
    void announce(Seconds render);
    std::string how_far(Seconds at) const;

    const double most;
    const PatienceLines lines;
    const std::function<Seconds()> now;
    const Seconds start;
    Seconds render_start{}, told{}, fastest{};
    long renders = 0; ///< that have begun
    bool has_announced = false, has_image = false;
    View last;
    std::string why_over;
};

} // namespace glcast::preload
