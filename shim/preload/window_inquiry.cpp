#include "shim/preload/window_inquiry.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

#include "shim/preload/own_thread.h"
#include "shim/preload/status.h"
#include "shim/preload/x_connection.h"

namespace glcast::preload {
namespace {

/// An X server that is busy answers in milliseconds.
constexpr std::chrono::milliseconds patience{250};

WindowAnswers look(const std::string& server, const std::vector<std::uint32_t>& names) {
    WindowAnswers answers;
    std::string why;
    const auto connection = XConnection::open(server, why);
    for (const std::uint32_t name : names) {
        WindowFacts& facts = answers[name];
        if (!connection || !connection->alive()) continue;
        facts.viewable = connection->is_viewable(name);
        if (facts.viewable) facts.title = connection->title(name);
    }
    return answers;
}

} // namespace

/// Shared with the thread that asks, which may outlive everybody's patience.
struct WindowInquiry::Question {
    std::string server;
    std::vector<std::uint32_t> names;
    std::mutex mutex; ///< guards what follows
    std::condition_variable changed;
    bool answered = false;
    WindowAnswers answers;

    void put() noexcept {
        WindowAnswers found;
        try {
            found = look(server, names);
        } catch (const std::exception&) {
            found.clear(); // out of memory: nothing is known
        }
        const std::lock_guard lock(mutex);
        answers = std::move(found);
        answered = true;
        changed.notify_all();
    }
    bool wait(std::chrono::milliseconds time) {
        std::unique_lock lock(mutex);
        return changed.wait_for(lock, time, [this] { return answered; });
    }
};

WindowAnswers WindowInquiry::ask(const std::string& server, std::vector<std::uint32_t> names) {
    const auto take = [this](std::chrono::milliseconds time) {
        if (!open || !open->wait(time)) return false;
        for (auto& [name, facts] : open->answers) known[name] = std::move(facts);
        open.reset();
        return true;
    };
    take(std::chrono::milliseconds(0));
    if (!open) {
        open = std::make_shared<Question>();
        open->server = server;
        open->names = std::move(names);
        if (!start_own_thread([question = open] { question->put(); })) open.reset();
    }
    if (open && !take(late == 0 ? patience : std::chrono::milliseconds(0)) && late++ == 0)
        say_once(
            "the X server does not answer while the program swaps (it may hold it by XGrabServer): titles of "
            "windows are known from the next frame on");
    return known;
}

} // namespace glcast::preload
