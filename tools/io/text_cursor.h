// Reading numbers and words out of text, quickly and with line numbers for messages.
#pragma once
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "tools/io/mesh_format.h"

namespace glcast::format {

class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : rest(text) {
        if (text.find('\n') == text.npos) line_end = '\r'; // as old Macs had it
    }

    /// The next line less its end, comments from `comment` on and spaces around it; false at the end of the
    /// text.
    bool next_line(std::string_view& line, char comment = '#') {
        if (rest.empty()) return false;
        const std::size_t end = rest.find(line_end);
        line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        ++number;
        line = trimmed(line.substr(0, line.find(comment)));
        return true;
    }

    /// As next_line, but past empty ones.
    bool next_full_line(std::string_view& line, char comment = '#') {
        do {
            if (!next_line(line, comment)) return false;
        } while (line.empty());
        return true;
    }

    std::string_view remaining() const { return rest; }
    std::size_t line() const { return number; } ///< the last that was read, from 1
    std::string here() const { return "line " + std::to_string(number) + ": "; }
    [[noreturn]] void fail(const std::string& why) const { refuse(here() + why); }

    static std::string_view trimmed(std::string_view s) {
        const std::size_t from = s.find_first_not_of(spaces);
        if (from == std::string_view::npos) return {};
        return s.substr(from, s.find_last_not_of(spaces) - from + 1);
    }

    /// Takes the next word off `line`; empty when there is none.
    static std::string_view word(std::string_view& line) {
        line = trimmed(line);
        const std::size_t end = line.find_first_of(spaces);
        const std::string_view w = line.substr(0, end);
        line.remove_prefix(w.size());
        return w;
    }

    /// Of numbers beyond a double: infinite or 0. No numbers and infinities are understood as C++, C and Visual C++
    /// write them: nan, -nan(ind), inf, 1.#QNAN.
    template <class T> static bool parse(std::string_view word, T& value) {
        if (!word.empty() && word[0] == '+') word.remove_prefix(1);
        const char* const last = word.data() + word.size();
        const auto [end, error] = std::from_chars(word.data(), last, value);
        if constexpr (std::is_floating_point_v<T>) {
            if (error == std::errc::result_out_of_range && end == last) {
                value = static_cast<T>(std::strtod(std::string(word).c_str(), nullptr));
                return true;
            }
            if (const std::size_t sharp = word.find(".#"); sharp != word.npos) {
                const bool infinite = word.substr(sharp + 2).starts_with("INF");
                value = infinite ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::quiet_NaN();
                if (infinite && word[0] == '-') value = -value;
                return true;
            }
        }
        return error == std::errc() && end == last;
    }

    /// The next number on `line`, which must be there.
    template <class T> T number_on(std::string_view& line, const char* what) const {
        T value{};
        const std::string_view w = word(line);
        if (w.empty()) fail(std::string(what) + " is missing");
        if (!parse(w, value)) fail(std::string(what) + " is no number");
        return value;
    }

  private:
    static constexpr const char* spaces = " \t\r\f\v";
    std::string_view rest;
    char line_end = '\n';
    std::size_t number = 0;
};

/// Gathers text or bytes and hands them to a file in large pieces.
class Gather {
  public:
    explicit Gather(OutputFile& target) : file(target) {}
    Gather& operator<<(std::string_view text) {
        buffer.append(text);
        if (buffer.size() > piece) flush();
        return *this;
    }
    Gather& operator<<(char c) { return *this << std::string_view(&c, 1); }
    /// The shortest text that is read back as the same number.
    Gather& operator<<(double value) { return shortest(value); }
    Gather& operator<<(float value) { return shortest(value); }
    Gather& operator<<(std::size_t value) {
        char text[24];
        return *this << std::string_view(text, std::to_chars(text, text + sizeof text, value).ptr - text);
    }
    template <class T> Gather& bytes(const T& value) {
        return *this << std::string_view(reinterpret_cast<const char*>(&value), sizeof value);
    }
    bool flush() {
        ok = ok && file.append(buffer.data(), buffer.size());
        buffer.clear();
        return ok;
    }

  private:
    template <class T> Gather& shortest(T value) {
        char text[40];
        const auto result = std::to_chars(text, text + sizeof text, value);
        return *this << std::string_view(text, result.ptr - text);
    }

    static constexpr std::size_t piece = 1u << 20;
    OutputFile& file;
    std::string buffer;
    bool ok = true;
};

} // namespace glcast::format
