#include "tools/io/ply_header.h"

#include <algorithm>
#include <cctype>

namespace glcast::format::ply {
namespace {

struct TypeName {
    std::string_view name, other;
    Type type;
    std::size_t size;
};
constexpr TypeName types[] = {
    {"char", "int8", Type::i8, 1},      {"uchar", "uint8", Type::u8, 1},     {"short", "int16", Type::i16, 2},
    {"ushort", "uint16", Type::u16, 2}, {"int", "int32", Type::i32, 4},      {"uint", "uint32", Type::u32, 4},
    {"float", "float32", Type::f32, 4}, {"double", "float64", Type::f64, 8},
};

struct SlotName {
    std::string_view name;
    Slot slot;
};
constexpr SlotName slot_names[] = {
    {"x", x},          {"y", y},          {"z", z},           {"nx", nx},          {"ny", ny},
    {"nz", nz},        {"normal_x", nx},  {"normal_y", ny},   {"normal_z", nz},    {"red", red},
    {"green", green},  {"blue", blue},    {"r", red},         {"g", green},        {"b", blue},
    {"diffuse_red", red}, {"diffuse_green", green}, {"diffuse_blue", blue},
    {"s", place_u},    {"t", place_v},    {"u", place_u},     {"v", place_v},
    {"texture_u", place_u}, {"texture_v", place_v},
};

Type type_of(const TextCursor& cursor, std::string_view word) {
    for (const TypeName& t : types)
        if (word == t.name || word == t.other) return t.type;
    cursor.fail("unknown type '" + std::string(word.substr(0, 20)) + "'");
}

void read_property(const TextCursor& cursor, std::string_view line, Header& header) {
    if (header.elements.empty()) cursor.fail("a property of no element");
    Property property;
    std::string_view word = TextCursor::word(line);
    if (word == "list") {
        property.list = type_of(cursor, TextCursor::word(line));
        word = TextCursor::word(line);
    }
    property.type = type_of(cursor, word);
    property.name = TextCursor::word(line);
    header.elements.back().properties.push_back(std::move(property));
}

Encoding encoding_of(const TextCursor& cursor, std::string_view word) {
    if (word == "ascii") return Encoding::ascii;
    if (word == "binary_little_endian") return Encoding::little;
    if (word == "binary_big_endian") return Encoding::big;
    cursor.fail("unknown format");
}

void read_comment(std::string_view line, Header& header) {
    const std::string_view what = TextCursor::word(line);
    if (what == "TextureFile") header.picture = TextCursor::trimmed(line);
    if (what == "glcast") header.ours = true;
}

bool plain_vertex(const Element& vertex) {
    return vertex.name == "vertex" && std::ranges::all_of(vertex.properties, [](const Property& p) {
               const Slot slot = slot_of(p.name);
               if (p.list) return false;
               if (slot <= nz) return p.type == Type::f32 && p.name.size() <= 2;
               if (slot <= blue) return p.type == Type::u8 && p.name.size() > 1;
               return slot == none;
           });
}

bool plain_face(const Element& face) {
    if (face.name != "face" || face.properties.empty()) return false;
    const Property& corners = face.properties[0];
    if ((corners.list != Type::u8 && corners.list != Type::i32) ||
        (corners.type != Type::i32 && corners.type != Type::u32) ||
        (corners.name != "vertex_indices" && corners.name != "vertex_index"))
        return false;
    return std::all_of(face.properties.begin() + 1, face.properties.end(), [](const Property& p) {
        const Slot slot = slot_of(p.name);
        return !p.list && ((slot >= red && slot <= blue && p.type == Type::u8 && p.name.size() > 1) || slot == none);
    });
}

} // namespace

std::size_t size_of(Type type) {
    return std::ranges::find(types, type, &TypeName::type)->size;
}

Slot slot_of(std::string_view name) {
    const auto* const found = std::ranges::find(slot_names, name, &SlotName::name);
    return found == std::end(slot_names) ? none : found->slot;
}

Header read_header(TextCursor& cursor) {
    std::string_view line;
    if (!cursor.next_line(line, '\0') || (line != "ply" && line != "PLY")) refuse("is no PLY file");
    Header header;
    while (cursor.next_line(line, '\0')) {
        const std::string_view what = TextCursor::word(line);
        if (what == "end_header") return header;
        if (what == "format") header.encoding = encoding_of(cursor, TextCursor::word(line));
        if (what == "property") read_property(cursor, line, header);
        if (what == "comment" || what == "obj_info") read_comment(line, header);
        if (what != "element") continue;
        Element& element = header.elements.emplace_back();
        element.name = TextCursor::word(line);
        element.count = cursor.number_on<std::size_t>(line, "the number of elements");
    }
    refuse("the file is truncated");
}

bool openmesh_reads(const Header& header) {
    return !header.ours && header.elements.size() == 2 && plain_vertex(header.elements[0]) &&
           plain_face(header.elements[1]) && header.elements[0].count < INT32_MAX && header.elements[1].count < INT32_MAX;
}

std::string plain_header(const Header& header) {
    constexpr const char* encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto name = [](Type type) { return std::string(std::ranges::find(types, type, &TypeName::type)->name) + " "; };
    std::string text = std::string("ply\nformat ") + encodings[static_cast<int>(header.encoding)] + " 1.0\n";
    for (const Element& element : header.elements) {
        text += "element " + element.name + " " + std::to_string(element.count) + "\n";
        for (const Property& p : element.properties) {
            text += p.list ? "property list " + name(*p.list) : "property ";
            text += name(p.type) + (p.list || slot_of(p.name) != none ? p.name : "other") + "\n";
        }
    }
    return text + "end_header\n";
}

bool floats_hold(std::string_view body) {
    constexpr int digits_of_float = 8;
    int digits = 0; // of the word so far, leading zeros left out
    for (std::size_t k = 0; k < body.size(); ++k) {
        const char c = body[k];
        if (c >= '0' && c <= '9')
            digits += c != '0' || digits > 0;
        else if (c == 'e' || c == 'E') {
            std::string_view exponent = body.substr(k + 1, 4);
            if (!exponent.empty() && (exponent[0] == '+' || exponent[0] == '-')) exponent.remove_prefix(1);
            std::size_t length = 0;
            while (length < exponent.size() && std::isdigit(static_cast<unsigned char>(exponent[length]))) ++length;
            if (length == 0 || length > 2 || exponent[0] > '2') return false;
        } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
            digits = 0;
        else if (c != '.' && c != '-' && c != '+')
            return false;
        if (digits > digits_of_float) return false;
    }
    return true;
}

} // namespace glcast::format::ply
