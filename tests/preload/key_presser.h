// A key that is pressed now and then while a program runs.
#pragma once
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/preload/program_run.h"

namespace glcast::test {

/// Presses F12 under our X server until it is told to stop.
class KeyPresser {
  public:
    KeyPresser() : thread([this] { press(); }) {}
    ~KeyPresser() {
        stop = true;
        thread.join();
    }

  private:
    void press() {
        while (!stop) {
            run_program({"xdotool", "key", "--delay", "30", "F12"}, {}, false);
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    }
    std::atomic<bool> stop{false};
    std::thread thread;
};

} // namespace glcast::test
