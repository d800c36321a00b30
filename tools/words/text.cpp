#include "tools/words/text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <utility>
#include <vector>

namespace glcast {
namespace {

/// Length of the character that `text` begins with, where it may be shown; 0: it is a control, or no UTF-8.
std::size_t shown_length(std::string_view text) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    std::uint32_t code = first & (length == 2 ? 0x1f : length == 3 ? 0x0f : 0x07);
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(k) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(k) & 0x3f);
    }
    constexpr std::uint32_t least[] = {0xa0, 0x800, 0x10000}; // below 0xa0 are the controls of ISO 6429
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return code >= least[length - 2] && code <= 0x10ffff && !surrogate ? length : 0;
}

std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last, now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) now[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(last, now);
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
    }
    return now.back();
}

} // namespace

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        if (const std::size_t length = shown_length(text)) {
            out += text.substr(0, length);
            text.remove_prefix(length);
            continue;
        }
        constexpr char digits[] = "0123456789abcdef";
        const auto byte = static_cast<unsigned char>(text[0]);
        out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
        text.remove_prefix(1);
    }
    return out;
}

std::string shell_word(const std::string& text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("_-./+:,@%=").find(char(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

std::string nearest(std::string_view word, std::span<const std::string> names) {
    std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
    std::string best;
    for (const std::string& name : names)
        if (const std::size_t off = distance(word, name); off < least) least = off, best = name;
    return best;
}

std::string enumeration(std::span<const std::string> names, const char* last) {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        text += (k == 0 ? "" : k + 1 == names.size() ? last : ", ") + names[k];
    return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
    return digits + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

} // namespace glcast
