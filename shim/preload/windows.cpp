#include "shim/preload/windows.h"

#include <algorithm>
#include <charconv>
#include <tuple>
namespace glcast::preload {
namespace {

/// Without a solid, while another window's is held.
constexpr int most_frames = 2;

std::string hexadecimal(std::uint32_t number) {
    char digits[16];
    const auto end = std::to_chars(digits, digits + sizeof digits, number, 16).ptr;
    return "0x" + std::string(digits, end);
}

bool is_number(const std::string& text, int base, std::uint32_t& number) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number, base);
    return error == std::errc{} && stop == end;
}

} // namespace

void Windows::surface_made(std::uintptr_t drawable, std::uint32_t window) { surfaces[drawable] = window; }

void Windows::drawn_to(std::uintptr_t drawable, std::uint32_t window) {
    if (drawable == 0) return;
    const auto [at, is_new] = windows.try_emplace(drawable);
    if (!is_new) return;
    at->second.number = static_cast<int>(windows.size());
    const auto surface = surfaces.find(drawable);
    at->second.name = surface != surfaces.end() ? surface->second : window;
}

std::vector<std::uint32_t> Windows::names() const {
    std::vector<std::uint32_t> all;
    for (const auto& [drawable, window] : windows)
        if (window.name != 0) all.push_back(window.name);
    return all;
}

void Windows::learn(const WindowAnswers& answers) {
    for (auto& [drawable, window] : windows) {
        const auto found = answers.find(window.name);
        window.viewable = window.name != 0 && (found == answers.end() || found->second.viewable);
        window.title = found == answers.end() ? "" : found->second.title;
    }
}

bool Windows::is_wanted(std::uintptr_t drawable, const std::string& wanted) const {
    const auto at = windows.find(drawable);
    if (at == windows.end()) return false;
    std::uint32_t number = 0;
    if (wanted.starts_with("0x")) return is_number(wanted.substr(2), 16, number) && at->second.name == number;
    if (is_number(wanted, 10, number)) return at->second.number == static_cast<int>(number);
    return at->second.title.find(wanted) != std::string::npos;
}

std::string Windows::describe(std::uintptr_t drawable) const {
    const auto at = windows.find(drawable);
    if (at == windows.end() || (windows.size() == 1 && at->second.title.empty())) return {};
    std::string text = "window " + std::to_string(at->second.number);
    if (!at->second.title.empty()) text += " \"" + at->second.title + "\"";
    return text;
}

std::string Windows::list() const {
    std::vector<const Window*> shown;
    for (const auto& [drawable, window] : windows)
        if (window.viewable) shown.push_back(&window);
    std::sort(shown.begin(), shown.end(), [](auto* a, auto* b) { return a->number < b->number; });
    std::string text;
    for (const Window* window : shown)
        text += (text.empty() ? "" : ", ") + std::to_string(window->number) + " \"" + window->title + "\" (" +
                hexadecimal(window->name) + ")";
    return text;
}

bool Windows::others_may_follow(std::uintptr_t drawable) const {
    return std::any_of(windows.begin(), windows.end(), [&](const auto& entry) {
        return entry.first != drawable && entry.second.viewable && !is_done(entry.first);
    });
}

bool Windows::any_may_follow() const { return others_may_follow(0); }

void Windows::hold(std::uintptr_t drawable, std::optional<Rating> rating) {
    Window& window = windows[drawable];
    if (rating) window.rated = any_held = true;
    if (!rating && any_held) ++window.frames_while_held;
    if (rating && (!best || better(*rating, *best))) best = std::move(rating);
}

bool Windows::is_done(std::uintptr_t drawable) const {
    const auto at = windows.find(drawable);
    return at != windows.end() && (at->second.rated || at->second.frames_while_held >= most_frames);
}

bool better(const Rating& a, const Rating& b) {
    const auto in_front = [](const Candidate& c) {
        return std::tuple(c.castable, !c.group.erased, !c.backdrop, !c.inset);
    };
    if (in_front(a.best) != in_front(b.best)) return in_front(a.best) > in_front(b.best);
    if (2 * std::min(a.substance, b.substance) < std::max(a.substance, b.substance))
        return a.substance > b.substance;
    const auto key = [](const Rating& r) {
        return std::tuple(r.best.group.kind == ProjectionKind::perspective, r.substance);
    };
    return key(a) > key(b);
}

} // namespace glcast::preload
