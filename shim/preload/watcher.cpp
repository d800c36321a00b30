#include "shim/preload/watcher.h"

#include <poll.h>

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "shim/preload/own_thread.h"
#include "shim/preload/status.h"
#include "shim/preload/x_connection.h"

namespace glcast::preload {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto idle_before_nudge = 300ms, wait_for_effect = 400ms;
constexpr int most_nudges = 20; // for one frame: a program that stays still after these will not draw at all
constexpr int look_ms = 50;

class Watcher {
  public:
    Watcher(const Options& of, std::string display_name, Watched what)
        : options(of), display(std::move(display_name)), watched(std::move(what)) {}

    void run() {
        if (!options.key.empty() || options.nudge) connect();
        while (!watched.over()) {
            wait_a_moment();
            watched.look_for_signals();
            watched.cast_at_rest();
            if (options.nudge && is_connected()) nudge_if_still();
        }
        if (is_connected()) undo_nudge();
    }

  private:
    void connect() {
        std::string why;
        connection = XConnection::open(display, why);
        if (connection && !options.key.empty()) why = connection->watch_key(options.key_symbol);
        if (!why.empty()) report(why);
    }

    bool is_connected() const { return connection && connection->alive(); }

    void wait_a_moment() {
        pollfd events = {is_connected() ? connection->file_descriptor() : -1, POLLIN, 0};
        poll(&events, 1, look_ms);
        if (!is_connected()) return;
        for (int presses = connection->key_presses(); presses > 0; --presses) watched.fire();
    }

    void report(const std::string& why) {
        const std::string line = "no key and no nudge: " + why;
        say("%s", line.c_str());
        if (!options.key.empty()) tell("failed", line);
    }

    /// First an exposure; if nothing is drawn, a pixel wider, then away from the screen, and back again
    /// whatever happens.
    void nudge_if_still() {
        const long now_ended = watched.frames();
        const auto now = Clock::now();
        if (now_ended != ended || !watched.waiting()) {
            ended = now_ended;
            since = now;
            next = Nudge::expose;
            if (!watched.waiting()) nudges = 0;
        }
        if (now - last_nudge >= wait_for_effect) undo_nudge();
        const bool still = now - since >= idle_before_nudge && now - last_nudge >= wait_for_effect;
        if (!watched.waiting() || !still || nudges >= most_nudges) return;
        last_nudge = now;
        ++nudges;
        nudge();
    }

    void nudge() {
        switch (next) {
        case Nudge::expose:
            connection->expose_windows();
            next = Nudge::widen;
            break;
        case Nudge::widen:
            connection->widen_windows(1);
            wider = true;
            next = Nudge::map;
            break;
        case Nudge::map:
            unmapped = connection->unmap_windows();
            next = Nudge::expose;
        }
    }

    void undo_nudge() {
        if (std::exchange(wider, false)) connection->widen_windows(-1);
        connection->map_windows(std::exchange(unmapped, {}));
    }

    enum class Nudge { expose, widen, map };

    const Options& options;
    const std::string display;
    const Watched watched;
    std::unique_ptr<XConnection> connection;
    long ended = -1;
    Clock::time_point since = Clock::now(), last_nudge = since;
    int nudges = 0;
    Nudge next = Nudge::expose;
    bool wider = false;
    std::vector<std::uint32_t> unmapped;
};

void watch(Watcher& watcher) noexcept {
    try {
        watcher.run();
    } catch (const std::exception& error) {
        say_once("the key is no longer watched: %s", error.what());
    }
}

} // namespace

void start_watcher(const Options& options, const std::string& display, Watched watched) {
    start_own_thread(
        [watcher = std::make_shared<Watcher>(options, display, std::move(watched))] { watch(*watcher); });
}

} // namespace glcast::preload
