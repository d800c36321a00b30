// The pictures that stand in the windows of a program that draws seldom: its last whole frames, kept until
// one is asked for (docs/design/architecture.md, "A program at rest").
#pragma once
#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

#include "shim/preload/session.h"

namespace glcast::preload {

/// Frames are counted for each window of each context.
using FrameKey = std::pair<const void*, std::uintptr_t>;

/// Which frames of a program are recorded though nobody has asked for one yet: its first, those that follow a
/// rest, and those of a program that draws seldom. Not those of one that draws all the time.
class Pace {
  public:
    using Clock = std::chrono::steady_clock;

    void frame_ended(Clock::time_point now);
    bool records_next() const { return left > 0; }
    /// No frame has ended for a while.
    bool is_still(Clock::time_point now) const;

  private:
    Clock::time_point last_end{};
    long ended = 0, left = 30;
};

struct StandingPicture {
    std::vector<FramePart> parts;
    FrameKey window;
    long number = 0;
    // Of all parts together.
    bool draws = false; ///< something that can be replayed
    long filled = 0;    ///< vertices
    bool hides = false; ///< nothing of an earlier frame is seen behind it
    std::size_t bytes = 0;
    long unseen = 0; ///< frames that ended later in that window and were not recorded
};
/// Of the frame that ended in `window`.
StandingPicture make_standing_picture(std::vector<FramePart> parts, FrameKey window, long number);

class StandingPictures {
  public:
    /// Those that are no longer seen, or could be replaced, go. Of the others no more than `most_bytes` stay.
    void show(StandingPicture picture, std::size_t most_bytes);
    /// Something has come into the window that was not recorded.
    void show_unseen(std::uintptr_t drawable);
    void forget_display(const void* display);
    /// It has no solid geometry.
    void forget_frame(FrameKey window, long number);
    void clear() { pictures.clear(); }
    bool empty() const { return pictures.empty(); }
    /// The last first.
    std::vector<StandingPicture> all() const { return {pictures.rbegin(), pictures.rend()}; }

  private:
    std::vector<StandingPicture> pictures; ///< in the order in which they came
};

} // namespace glcast::preload
