#include "tools/io/obj_text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>

#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes [sign] digits off the front; how many digits.
int take_integer(std::string_view& word) {
    if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.remove_prefix(1);
    int digits = 0;
    while (!word.empty() && is_digit(word[0])) word.remove_prefix(1), ++digits;
    return digits;
}

/// v, v/vt, v//vn or v/vt/vn, of numbers that an int holds.
bool is_corner(std::string_view word) {
    std::string_view rest = word;
    const int digits = take_integer(rest);
    if (digits < 1 || digits > 9 || word.find_first_of("123456789") >= word.size() - rest.size()) return false;
    for (int k = 0; k < 2 && !rest.empty(); ++k) {
        if (rest[0] != '/') return false;
        rest.remove_prefix(1);
        if (take_integer(rest) > 9) return false;
    }
    return rest.empty();
}

class Plainer {
  public:
    explicit Plainer(std::string_view bytes) : cursor(bytes) { text.plain.reserve(bytes.size() + bytes.size() / 2); }

    ObjText run() {
        std::string line;
        while (next(line)) {
            std::string_view rest = line;
            take(TextCursor::word(rest), rest);
        }
        if (coloured < text.positions.size()) text.colours.clear();
        return std::move(text);
    }

  private:
    /// Whole: continued ones are put together.
    bool next(std::string& line) {
        std::string_view piece;
        line.clear();
        do {
            if (!cursor.next_line(piece, '\0')) return !line.empty();
            if (line.empty() && piece.starts_with('#')) return true;
            const bool goes_on = piece.ends_with('\\');
            if (goes_on) piece.remove_suffix(1);
            line.append(piece).push_back(' ');
            if (!goes_on) break;
        } while (true);
        return true;
    }

    void take(std::string_view what, std::string_view rest) {
        if (what == "mtllib") return libraries(rest);
        if (what == "usemtl") return use(TextCursor::trimmed(rest));
        rest = rest.substr(0, rest.find('#'));
        if (what == "v") return vertex(rest);
        if (what == "vn") return normal(rest);
        if (what == "vt") return place(rest);
        if (what == "f" || what == "fo") face(rest);
    }

    void put(double value) {
        constexpr double most = std::numeric_limits<float>::max();
        const float narrow = std::isnan(value) ? 0.0f : static_cast<float>(std::clamp(value, -most, most));
        char word[32];
        const auto end = std::to_chars(word, word + sizeof word, narrow, std::chars_format::general).ptr;
        text.plain.append(" ").append(word, end);
    }

    void vertex(std::string_view rest) {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) p[k] = cursor.number_on<double>(rest, "a coordinate");
        float extra[4] = {};
        int count = 0;
        for (std::string_view w = TextCursor::word(rest); count < 4 && !w.empty(); w = TextCursor::word(rest), ++count) {
            double value = 0;
            if (!TextCursor::parse(w, value)) break;
            extra[count] = static_cast<float>(value);
        }
        text.positions.push_back(p);
        text.colours.emplace_back(extra[0], extra[1], extra[2]); // one number is a weight
        coloured += count >= 3;
        text.plain.push_back('v');
        for (int k = 0; k < 3; ++k) put(p[k]);
        text.plain.append(" 1 1 1\n");
    }

    /// Of length 1, so that none vanishes in a float.
    void normal(std::string_view rest) {
        glm::dvec3 n;
        for (int k = 0; k < 3; ++k) n[k] = cursor.number_on<double>(rest, "a normal");
        const double length = glm::length(n);
        if (std::isfinite(length) && length > 0) n /= length;
        text.plain.append("vn");
        for (int k = 0; k < 3; ++k) put(n[k]);
        text.plain.push_back('\n');
    }

    void place(std::string_view rest) {
        double at[2] = {};
        for (double& value : at) TextCursor::parse(TextCursor::word(rest), value);
        text.plain.append("vt"), put(at[0]), put(at[1]);
        text.plain.push_back('\n');
    }

    void face(std::string_view rest) {
        std::uint32_t size = 0;
        text.plain.push_back('f');
        for (std::string_view w = TextCursor::word(rest); !w.empty(); w = TextCursor::word(rest), ++size) {
            if (!is_corner(w)) cursor.fail("a face index is no number");
            text.plain.append(" ").append(w);
        }
        text.plain.push_back('\n');
        if (size < 3) cursor.fail("a face has fewer than three corners");
        text.sizes.push_back(size);
        text.lines.push_back(static_cast<std::uint32_t>(cursor.line()));
        text.materials.push_back(material);
    }

    void use(std::string_view name) {
        const auto [found, is_new] = numbers.try_emplace(std::string(name), static_cast<int>(text.names.size()));
        if (is_new) text.names.emplace_back(name);
        material = found->second;
    }

    /// Some write several, parted by blanks; others write blanks into a name.
    void libraries(std::string_view rest) {
        const std::string_view whole = TextCursor::trimmed(rest);
        text.libraries.emplace_back(whole);
        if (whole.find_first_of(" \t") == whole.npos) return;
        while (!TextCursor::trimmed(rest).empty()) text.libraries.emplace_back(TextCursor::word(rest));
    }

    TextCursor cursor;
    ObjText text;
    std::size_t coloured = 0;
    int material = -1;
    std::unordered_map<std::string, int> numbers; ///< of materials
};

} // namespace

ObjText obj_text(std::string_view bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3); // byte order mark
    return Plainer(bytes).run();
}

} // namespace glcast::format
