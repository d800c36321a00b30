// Object File Format as Geomview describes it (oogl, "OFF Files"): [ST][C][N][4]OFF, in text with lines broken anywhere, or BINARY;
// also with a line each and more numbers on it than there should be, as others write it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "tools/io/mesh_format.h"
#include "tools/io/soup.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

constexpr glm::vec3 no_colour(0.8f);

struct Kind {
    bool places = false, colours = false, normals = false, weights = false, binary = false;
};

/// "STCN4OFF" less what it does not have.
std::optional<Kind> kind_of(std::string_view word) {
    Kind kind;
    if (!word.ends_with("OFF")) return std::nullopt;
    word.remove_suffix(3);
    const auto take = [&](std::string_view letters) {
        if (!word.starts_with(letters)) return false;
        word.remove_prefix(letters.size());
        return true;
    };
    kind.places = take("ST");
    kind.colours = take("C");
    kind.normals = take("N");
    kind.weights = take("4");
    if (!word.empty()) refuse("is of a kind of OFF that is not read: n dimensions");
    return kind;
}

struct Number {
    double value;
    bool whole;         ///< spelled without a point
    std::uint32_t line;
};

struct OffText {
    std::vector<Number> numbers; ///< behind the keyword
    std::vector<std::size_t> line_starts;
};

OffText numbers_of(TextCursor& cursor, std::string_view rest) {
    OffText text;
    do {
        text.line_starts.push_back(text.numbers.size());
        for (std::string_view w = TextCursor::word(rest); !w.empty(); w = TextCursor::word(rest)) {
            double value = 0;
            if (!TextCursor::parse(w, value)) cursor.fail("'" + std::string(w.substr(0, 20)) + "' is no number");
            text.numbers.push_back({value, w.find_first_of(".eEnN") == w.npos, static_cast<std::uint32_t>(cursor.line())});
        }
    } while (cursor.next_full_line(rest));
    return text;
}

/// One way to understand the numbers. Throws when they are otherwise.
class Attempt {
  public:
    struct How {
        bool by_lines;        ///< a vertex and a face a line, what is over at the end of it is not looked at
        int colour_numbers;   ///< of a vertex
        bool face_colours;    ///< up to four numbers behind a face on its line
        bool edges = true;    ///< their number stands behind those of vertices and faces
        bool polygons = true; ///< every face has three corners or more
    };
    Attempt(const OffText& text, const Kind& kind, const How& how) : text(text), kind(kind), how(how) {}

    Soup read() {
        const std::size_t vertices = count("the number of vertices"), faces = count("the number of faces");
        if (how.by_lines ? same_line() : how.edges) ++at; // as often wrong as not
        if (vertices > text.numbers.size() / 3 || faces > text.numbers.size()) refuse("the file is truncated, or its counts are wrong");
        for (std::size_t v = 0; v < vertices; ++v) vertex();
        for (std::size_t f = 0; f < faces; ++f) face(vertices);
        if (at < text.numbers.size() && !how.by_lines) refuse("there is more in the file than its counts say");
        finish();
        return std::move(soup);
    }

  private:
    double next() {
        if (at >= text.numbers.size()) refuse("the file is truncated");
        return text.numbers[at++].value;
    }
    bool same_line() const {
        return at > 0 && at < text.numbers.size() && text.numbers[at].line == text.numbers[at - 1].line;
    }
    void to_next_line() {
        while (same_line()) ++at;
    }
    [[noreturn]] void fail(const std::string& why) const {
        refuse("line " + std::to_string(text.numbers[std::min(at, text.numbers.size()) - 1].line) + ": " + why);
    }
    std::size_t count(const char* what) {
        const double value = next();
        if (!(value >= 0) || value != std::floor(value)) fail(std::string(what) + " is no whole number");
        if (value > UINT32_MAX) refuse("the file is truncated, or its counts are wrong");
        return static_cast<std::size_t>(value);
    }

    void vertex() {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) p[k] = next();
        if (kind.weights) {
            const double weight = next();
            if (!(weight > 0)) refuse("a vertex has a weight that is not above 0: the file has four dimensions");
            p /= weight;
        }
        soup.positions.push_back(p);
        if (kind.normals) {
            glm::vec3 n;
            for (int k = 0; k < 3; ++k) n[k] = static_cast<float>(next());
            soup.normals.push_back(n);
        }
        const bool extra = how.by_lines && !kind.colours && extra_numbers() >= 3;
        bool whole = true; // they are scaled together
        if (kind.colours || extra) soup.colours.push_back(colour(whole, extra ? 3 : how.colour_numbers));
        if (kind.places && !how.by_lines) next(), next();
        if (how.by_lines) to_next_line();
    }

    std::size_t extra_numbers() const {
        std::size_t end = at;
        while (end < text.numbers.size() && end > 0 && text.numbers[end].line == text.numbers[at - 1].line) ++end;
        return end - at;
    }

    /// `whole` stays true when no number has a point.
    glm::vec3 colour(bool& whole, int numbers) {
        glm::vec3 c;
        for (int k = 0; k < numbers; ++k) {
            whole = whole && (at >= text.numbers.size() || text.numbers[at].whole);
            const double value = next();
            if (k < 3) c[k] = static_cast<float>(value);
        }
        return c;
    }

    void face(std::size_t vertices) {
        const std::size_t corners = count("the number of corners");
        if (corners > text.numbers.size() - at) refuse("the file is truncated");
        if (corners < 3 && how.polygons) fail("a face has fewer than three corners");
        if (corners >= 3) soup.begin_face();
        for (std::size_t k = 0; k < corners; ++k) {
            const std::size_t v = count("a corner");
            if (v >= vertices) fail("a face has corner " + std::to_string(v) + " of " + std::to_string(vertices) + " vertices");
            if (corners >= 3) soup.corner(static_cast<std::uint32_t>(v));
        }
        const std::size_t extra = extra_numbers();
        if (!how.by_lines && (!how.face_colours || extra > 4)) return;
        if (corners >= 3) face_colour(extra);
        to_next_line();
    }

    void face_colour(std::size_t numbers) {
        soup.face_colours.resize(soup.sizes.size(), glm::vec3(-1));
        if (numbers < 3) return; // one: a place in the colour map of the reader
        bool whole = true;
        soup.face_colours.back() = colour(whole, 3);
        (whole ? whole_faces : part_faces).push_back(soup.sizes.size() - 1);
    }

    /// Whole numbers are of 0..255, unless the file has none above 1.
    void finish() {
        if (soup.colours.size() != soup.positions.size()) soup.colours.clear();
        scale_colours(soup.colours, false);
        for (const std::vector<std::size_t>* faces : {&whole_faces, &part_faces}) {
            std::vector<glm::vec3> colours;
            for (const std::size_t f : *faces) colours.push_back(soup.face_colours[f]);
            scale_colours(colours, false);
            for (std::size_t k = 0; k < faces->size(); ++k) soup.face_colours[(*faces)[k]] = colours[k];
        }
        const auto known = [](const glm::vec3& c) { return c.x >= 0; };
        if (std::none_of(soup.face_colours.begin(), soup.face_colours.end(), known)) soup.face_colours.clear();
        if (soup.face_colours.empty()) return;
        soup.face_colours.resize(soup.sizes.size(), glm::vec3(-1));
        for (glm::vec3& c : soup.face_colours)
            if (!known(c)) c = no_colour;
    }

    const OffText& text;
    const Kind kind;
    const How how;
    Soup soup;
    std::size_t at = 0;
    std::vector<std::size_t> whole_faces, part_faces;
};

Soup read_text(TextCursor& cursor, std::string_view rest, const Kind& kind) {
    const OffText text = numbers_of(cursor, rest);
    std::vector<Attempt::How> ways; // as Geomview has it first
    for (const bool polygons : {true, false}) {
        for (const bool edges : {true, false})
            for (const bool face_colours : {true, false})
                for (int numbers = 4; numbers >= (kind.colours ? 3 : 4); --numbers)
                    ways.push_back({false, numbers, face_colours, edges, polygons});
        ways.push_back({true, 3, true, true, polygons});
    }
    std::string why;
    for (const Attempt::How& how : ways) {
        try {
            return Attempt(text, kind, how).read();
        } catch (const std::runtime_error& e) {
            if (why.empty()) why = e.what();
        }
    }
    refuse(why);
}

/// Big-endian, as Geomview writes it, or little-endian, as OpenMesh does.
class Binary {
  public:
    Binary(std::string_view bytes, bool big) : rest(bytes), big(big) {}

    Soup read(const Kind& kind) {
        const std::uint32_t vertices = whole(), faces = whole();
        whole(); // edges
        if (vertices > rest.size() / 12 || faces > rest.size() / 4) refuse("the file is truncated, or its counts are wrong");
        Soup soup;
        for (std::uint32_t v = 0; v < vertices; ++v) {
            soup.positions.emplace_back(vec3());
            if (kind.weights) soup.positions.back() /= double(part());
            if (kind.normals) soup.normals.push_back(vec3());
            if (kind.colours) soup.colours.push_back(vec3()), part();
            if (kind.places) part(), part();
        }
        for (std::uint32_t f = 0; f < faces; ++f) {
            const std::uint32_t corners = whole();
            if (corners > rest.size() / 4) refuse("the file is truncated, or its counts are wrong");
            if (corners >= 3) soup.begin_face();
            for (std::uint32_t k = 0; k < corners; ++k) {
                const std::uint32_t v = whole();
                if (corners >= 3) soup.corner(v);
            }
            const std::uint32_t numbers = whole();
            if (numbers > 4) refuse("a face has a colour of " + std::to_string(numbers) + " numbers");
            glm::vec3 colour = no_colour;
            for (std::uint32_t k = 0; k < numbers; ++k)
                if (const float value = part(); k < 3 && numbers >= 3) colour[int(k)] = value;
            coloured = coloured || numbers >= 3;
            if (corners >= 3) soup.face_colours.push_back(colour);
        }
        if (!coloured) soup.face_colours.clear();
        return soup;
    }

  private:
    std::uint32_t whole() {
        std::uint32_t value;
        if (rest.size() < 4) refuse("the file is truncated");
        std::memcpy(&value, rest.data(), 4);
        rest.remove_prefix(4);
        return big ? __builtin_bswap32(value) : value;
    }
    float part() { return std::bit_cast<float>(whole()); }
    glm::vec3 vec3() {
        glm::vec3 v;
        for (int k = 0; k < 3; ++k) v[k] = part();
        return v;
    }

    std::string_view rest;
    bool big, coloured = false;
};

Soup read_binary(std::string_view body, const Kind& kind) {
    try {
        return Binary(body, true).read(kind);
    } catch (const std::runtime_error&) {
        return Binary(body, false).read(kind);
    }
}

} // namespace

std::vector<Level> read_off(std::string_view bytes, const std::filesystem::path&) {
    TextCursor cursor(bytes);
    std::string_view line;
    if (!cursor.next_full_line(line)) refuse("is no OFF file");
    std::string_view rest = line;
    double number = 0;
    const std::string_view word = TextCursor::word(rest);
    std::optional<Kind> kind = kind_of(word);
    if (!kind && TextCursor::parse(word, number)) kind.emplace(), rest = line; // the keyword may be missing
    if (!kind) refuse("is no OFF file");
    if (TextCursor::trimmed(rest).starts_with("BINARY")) return {level_of(read_binary(cursor.remaining(), *kind))};
    return {level_of(read_text(cursor, rest, *kind))};
}

} // namespace glcast::format
