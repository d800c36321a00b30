// The windows that a process draws to with OpenGL, and which of them is cast.
//
// Programs with several windows end a frame in each. The first with solid geometry is cast at once, since it
// may never be drawn again; each other window gets a chance to show something better, until all have had it
// or a moment has passed. --window takes one of them and waits for no other.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shim/preload/choice.h"
#include "shim/preload/window_inquiry.h"

namespace glcast::preload {

/// What a window's best group of draws is worth beside another's.
struct Rating {
    Candidate best;
    long substance = 0; ///< triangles and what else may become solid
};

/// Not for use by several threads at a time.
class Windows {
  public:
    struct Window {
        int number = 0;            ///< from 1, in the order in which they were first drawn to
        std::uint32_t name = 0;    ///< the X server's; 0: not known, or no window
        bool viewable = false;     ///< on the screen
        std::string title;         ///< its own, or of the window that it is in
        bool rated = false;        ///< it has shown a solid
        int frames_while_held = 0; ///< without
    };

    /// A surface of GLX or EGL that shows in a window of X.
    void surface_made(std::uintptr_t drawable, std::uint32_t window);
    /// A context of desktop GL draws to it.
    void drawn_to(std::uintptr_t drawable, std::uint32_t window);
    /// The X server's names of all.
    std::vector<std::uint32_t> names() const;
    /// What the X server says of them. One of which it has not said anything yet may be on the screen.
    void learn(const WindowAnswers& answers);
    std::size_t count() const { return windows.size(); }

    /// `wanted` as given by --window: a number, 0x and the server's name, or a part of the title.
    bool is_wanted(std::uintptr_t drawable, const std::string& wanted) const;
    /// `window 2 "Front view"`; empty where there is nothing to tell it from.
    std::string describe(std::uintptr_t drawable) const;
    /// All that are on the screen: `1 "Top" (0x200003), 2 ...`
    std::string list() const;

    /// Others on the screen that may still show something better.
    bool others_may_follow(std::uintptr_t drawable) const;
    bool any_may_follow() const;
    /// What is cast so far.
    const std::optional<Rating>& held() const { return best; }
    void hold(std::uintptr_t drawable, std::optional<Rating> rating);
    /// A frame of this window would be looked at for nothing.
    bool is_done(std::uintptr_t drawable) const;

  private:
    std::map<std::uintptr_t, Window> windows; ///< by drawable
    std::map<std::uintptr_t, std::uint32_t> surfaces;
    std::optional<Rating> best;
    bool any_held = false;
};

/// At least twice as much, or about as much and what people mean rather: see `rank`.
bool better(const Rating& a, const Rating& b);

} // namespace glcast::preload
