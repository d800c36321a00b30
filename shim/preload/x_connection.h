// A connection of our own to the X server: keys are watched and windows nudged without touching the
// program's connection, its events or its error handlers.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace glcast::preload {

class XConnection {
  public:
    /// `display` as in $DISPLAY. Null, with one line in `why`, when there is no libxcb or no server.
    static std::unique_ptr<XConnection> open(const std::string& display, std::string& why);
    ~XConnection();
    XConnection(const XConnection&) = delete;
    XConnection& operator=(const XConnection&) = delete;

    /// False after the server has gone; nothing else may be called then.
    bool alive() const;
    int file_descriptor() const;

    /// From now on see each press of the key, whichever window has the focus: raw events (XInput 2) are
    /// copies, so nobody loses any. One clear line when that cannot be.
    std::string watch_key(std::uint32_t symbol);
    /// How often the key went down since the last call. Does not wait.
    int key_presses();

    /// Mapped, with all that it is in. False for what is no window.
    bool is_viewable(std::uint32_t window);
    /// Of the window, or of the nearest that it is in and that has one; in UTF-8, empty: none.
    std::string title(std::uint32_t window);

    /// Tell the windows of this process that they were exposed. Returns how many there are.
    int expose_windows();
    /// Make its top-level windows wider by `pixels`, or narrower.
    void widen_windows(int pixels);
    /// Take them off the screen. Returns those that went, which are to be mapped again.
    std::vector<std::uint32_t> unmap_windows();
    void map_windows(const std::vector<std::uint32_t>& windows);

  private:
    struct Calls;
    struct Windows;
    XConnection() = default;
    static const Calls* calls();
    Windows find_windows();

    void* connection = nullptr;
    std::uint8_t input_opcode = 0;
    std::uint32_t key = 0;
    bool key_is_down = false;
};

} // namespace glcast::preload
