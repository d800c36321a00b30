// Triggers that several threads fire, look for and take at the same time.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "shim/preload/triggers.h"

namespace glcast::preload {
namespace {

Options armed(long captures) {
    Options options;
    options.armed = true;
    options.captures = captures;
    options.key = "F12"; // none is owed at the start
    return options;
}

/// Lets two threads go on at the same moment, again and again.
class Start {
  public:
    void wait() {
        const int round = arrived.fetch_add(1) / 2;
        for (int looks = 0; arrived / 2 == round; ++looks)
            if (looks > 2000) std::this_thread::yield(); // the other has no processor now
    }

  private:
    std::atomic<int> arrived{0};
};

/// Runs `one` and `other` at the same moment on two threads, and then `after`, for half a second.
template <class One, class Other, class After> void collide(One&& one, Other&& other, After&& after) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
    Start start;
    std::atomic<bool> over{false};
    std::thread thread([&] {
        for (start.wait(); !over; start.wait()) {
            other();
            start.wait();
        }
    });
    while (!over) {
        start.wait();
        one();
        start.wait();
        after();
        over = std::chrono::steady_clock::now() > end;
    }
    start.wait();
    thread.join();
}

TEST(Races, ASignalCountsOnceHoweverManyThreadsLook) {
    Options options = armed(0);
    options.signal = SIGUSR1;
    Triggers triggers(options);
    triggers.look_for_signals(); // puts the handler
    long sent = 0, fired = 0;
    collide(
        [&] {
            raise(SIGUSR1), ++sent;
            triggers.look_for_signals();
        },
        [&] { triggers.look_for_signals(); },
        [&] {
            triggers.look_for_signals();
            for (; triggers.waiting(); ++fired) triggers.taken();
        });
    signal(SIGUSR1, SIG_DFL);
    EXPECT_GT(sent, 0);
    EXPECT_EQ(fired, sent);
}

TEST(Races, NothingIsWaitedForAfterGivingUp) {
    const Options options = armed(0);
    std::optional<Triggers> triggers(options);
    int waits = 0;
    collide([&] { triggers->give_up(); }, [&] { triggers->fire(); },
            [&] {
                waits += triggers->waiting();
                triggers.emplace(options);
            });
    EXPECT_EQ(waits, 0);
}

} // namespace
} // namespace glcast::preload
