// .ply, ASCII and binary of both byte orders: any elements and properties, of which vertex and face are read.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "tools/io/level_set.h"
#include "tools/io/mesh_format.h"
#include "tools/io/text_cursor.h"

namespace glcast::format {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

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

struct Property {
    std::string name;
    Type type = Type::f32;
    std::optional<Type> list; ///< type of the count
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little, big };

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
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

Header read_header(TextCursor& cursor) {
    std::string_view line;
    if (!cursor.next_line(line, '\0') || line != "ply") refuse("is no PLY file");
    Header header;
    while (cursor.next_line(line, '\0')) {
        const std::string_view what = TextCursor::word(line);
        if (what == "end_header") return header;
        if (what == "format") header.encoding = encoding_of(cursor, TextCursor::word(line));
        if (what == "property") read_property(cursor, line, header);
        if (what != "element") continue;
        Element& element = header.elements.emplace_back();
        element.name = TextCursor::word(line);
        element.count = cursor.number_on<std::size_t>(line, "the number of elements");
    }
    refuse("the file is truncated");
}

/// The values of the body, one after another, whatever the encoding.
class Values {
  public:
    Values(std::string_view body, Encoding encoding) : rest(body), encoding(encoding) {}

    double next(Type type) {
        if (encoding == Encoding::ascii) return next_word();
        switch (type) {
        case Type::i8:
            return take<std::int8_t>();
        case Type::u8:
            return take<std::uint8_t>();
        case Type::i16:
            return take<std::int16_t>();
        case Type::u16:
            return take<std::uint16_t>();
        case Type::i32:
            return take<std::int32_t>();
        case Type::u32:
            return take<std::uint32_t>();
        case Type::f32:
            return take<float>();
        case Type::f64:
            return take<double>();
        }
        return 0;
    }
    std::size_t left() const { return rest.size(); }

  private:
    double next_word() {
        const std::size_t from = rest.find_first_not_of(" \t\r\n");
        if (from == rest.npos) refuse("the file is truncated");
        rest.remove_prefix(from);
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
        double value = 0;
        if (!TextCursor::parse(word, value)) refuse("'" + std::string(word.substr(0, 20)) + "' is no number");
        rest.remove_prefix(word.size());
        return value;
    }
    template <class T> T take() {
        char bytes[sizeof(T)];
        if (rest.size() < sizeof(T)) refuse("the file is truncated");
        std::memcpy(bytes, rest.data(), sizeof(T));
        rest.remove_prefix(sizeof(T));
        if (encoding == Encoding::big) std::reverse(bytes, bytes + sizeof(T));
        return std::bit_cast<T>(std::to_array(bytes));
    }

    std::string_view rest;
    Encoding encoding;
};

std::size_t list_length(Values& values, Type type) {
    const double length = values.next(type);
    if (!(length >= 0) || length > double(values.left())) refuse("a list is longer than the file");
    return static_cast<std::size_t>(length);
}

// Normals and colours of a face's corners: the second as MeshLab has it, the first ours in the same manner.
constexpr std::string_view wedge_normals = "normal", wedge_colours = "color";

/// Where a property of a vertex goes: position 0..2, normal 3..5, colour 6..8; -1 nowhere.
int vertex_slot(std::string_view name) {
    constexpr std::string_view names[] = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
    constexpr std::string_view others[] = {"", "", "", "", "", "", "r", "g", "b"};
    for (int k = 0; k < 9; ++k)
        if (name == names[k] || (!others[k].empty() && name == others[k])) return k;
    return -1;
}

double colour_scale(Type type) {
    if (type == Type::u8) return 255;
    return type == Type::u16 ? 65535 : 1;
}

void read_vertices(Values& values, const Element& element, Mesh& mesh) {
    std::vector<int> slots;
    unsigned have = 0;
    for (const Property& p : element.properties) {
        slots.push_back(p.list ? -1 : vertex_slot(p.name));
        if (slots.back() >= 0) have |= 1u << slots.back();
    }
    if ((have & 7) != 7) refuse("its vertices have no x, y and z");
    const bool normals = (have & 0x38) == 0x38, colours = (have & 0x1c0) == 0x1c0;
    for (std::size_t v = 0; v < element.count; ++v) {
        double slot[9] = {};
        for (std::size_t k = 0; k < slots.size(); ++k) {
            const Property& p = element.properties[k];
            std::size_t count = p.list ? list_length(values, *p.list) : 1;
            for (; count > 0; --count) {
                const double value = values.next(p.type);
                if (slots[k] >= 0) slot[slots[k]] = slots[k] >= 6 ? value / colour_scale(p.type) : value;
            }
        }
        mesh.positions.emplace_back(slot[0], slot[1], slot[2]);
        if (normals) mesh.normals.emplace_back(slot[3], slot[4], slot[5]);
        if (colours) mesh.colours.emplace_back(slot[6], slot[7], slot[8]);
    }
}

/// Three numbers for each corner of a face, as a list.
struct CornerList {
    std::string_view name;
    CornerValues& values; ///< by triangle, while every face has them
    std::vector<double> face{};

    bool takes(const Property& p) const { return p.list && p.name == name; }
    /// To the triangles of the face, a fan as add_fan makes it, which begin at number `first`.
    void add(std::size_t first, std::size_t corners) {
        if (values.size() == first && face.size() == 3 * corners)
            for (std::size_t k = 2; k < corners; ++k) values.push_back({at(0), at(k - 1), at(k)});
        face.clear();
    }

  private:
    glm::vec3 at(std::size_t corner) const {
        return {face[3 * corner], face[3 * corner + 1], face[3 * corner + 2]};
    }
};

std::uint32_t corner_from(double value) {
    if (!(value >= 0) || value > UINT32_MAX || value != std::floor(value)) refuse("a face has an impossible corner");
    return static_cast<std::uint32_t>(value);
}

void read_faces(Values& values, const Element& element, Mesh& mesh, CornerValues& normals, CornerValues& colours) {
    std::vector<std::uint32_t> corners;
    CornerList lists[] = {{wedge_normals, normals}, {wedge_colours, colours}};
    for (std::size_t f = 0; f < element.count; ++f) {
        corners.clear();
        for (const Property& p : element.properties) {
            const bool wanted = p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
            for (std::size_t count = p.list ? list_length(values, *p.list) : 1; count > 0; --count) {
                const double value = values.next(p.type);
                if (wanted) corners.push_back(corner_from(value));
                for (CornerList& list : lists)
                    if (list.takes(p)) list.face.push_back(value / colour_scale(p.type));
            }
        }
        const std::size_t first = mesh.triangles.size();
        add_fan(mesh, corners);
        for (CornerList& list : lists) list.add(first, corners.size());
    }
}

/// Of the mesh once it is whole.
Wedges wedges_from(Mesh& mesh, CornerValues& normals, CornerValues& colours) {
    for (CornerValues* values : {&normals, &colours})
        if (values->size() != mesh.triangles.size()) values->clear();
    for (const Triangle& t : mesh.triangles)
        if (std::max({t[0], t[1], t[2]}) >= mesh.positions.size()) return {}; // read_levels says so
    if (normals.empty() && colours.empty()) return {};
    return take_corner_values(mesh, normals, colours);
}

void skip(Values& values, const Element& element) {
    for (std::size_t k = 0; k < element.count; ++k)
        for (const Property& p : element.properties)
            for (std::size_t count = p.list ? list_length(values, *p.list) : 1; count > 0; --count)
                values.next(p.type);
}

} // namespace

std::vector<Level> read_ply(std::string_view bytes) {
    TextCursor cursor(bytes);
    const Header header = read_header(cursor);
    Values values(cursor.remaining(), header.encoding);
    std::vector<Level> levels = one_level({});
    Mesh& mesh = levels[0].mesh;
    CornerValues normals, colours;
    for (const Element& element : header.elements) {
        if (element.properties.empty()) continue;
        if (element.count > values.left()) refuse("the file is truncated, or its counts are wrong");
        if (element.name == "vertex")
            read_vertices(values, element, mesh);
        else if (element.name == "face")
            read_faces(values, element, mesh, normals, colours);
        else
            skip(values, element);
    }
    levels[0].wedges = wedges_from(mesh, normals, colours);
    return levels;
}

namespace {

std::array<glm::vec3, 3> in_bytes(std::array<glm::vec3, 3> colours) {
    for (glm::vec3& c : colours)
        for (int k = 0; k < 3; ++k) c[k] = float(std::lround(c[k] * 255)) / 255;
    return colours;
}

} // namespace

/// Texture coordinates, and normals and colours of wedges, belong to corners, as MeshLab writes them: the mesh stays
/// as it is.
bool write_ply(FileSet& files, const std::filesystem::path& path, const Level& level) {
    const Mesh& mesh = level.mesh;
    const bool textured = !level.texture.empty();
    PictureNames names;
    Gather out(files.mesh(path));
    if (textured && !write_pictures(files, path, level.texture, false, names)) return false;
    const Wedges& wedges = level.wedges;
    const bool wide = needs_doubles(mesh), normals = !mesh.normals.empty(), colours = !mesh.colours.empty();
    out << "ply\nformat binary_little_endian 1.0\ncomment glcast " GLCAST_VERSION "\n";
    if (level.set.count > 0) out << "comment " << mark_name << ": " << mark_of(level.set) << '\n';
    if (textured) out << "comment TextureFile " << names.colour << '\n';
    out << "element vertex " << mesh.positions.size() << '\n';
    for (const char* name : {"x", "y", "z"})
        out << (wide ? "property double " : "property float ") << name << '\n';
    if (normals) out << "property float nx\nproperty float ny\nproperty float nz\n";
    if (colours) out << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out << "element face " << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\n";
    if (textured) out << "property list uchar float texcoord\n";
    if (!wedges.normals.empty()) out << "property list uchar float " << wedge_normals << '\n';
    if (!wedges.colours.empty()) out << "property list uchar float " << wedge_colours << '\n';
    out << "end_header\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (wide)
            out.bytes(mesh.positions[v]);
        else
            out.bytes(glm::vec3(mesh.positions[v]));
        if (normals) out.bytes(mesh.normals[v]);
        for (int k = 0; k < 3 && colours; ++k)
            out << static_cast<char>(std::lround(mesh.colours[v][k] * 255.0f));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out << '\3', out.bytes(mesh.triangles[t]);
        if (textured) {
            out << '\6';
            for (const glm::vec2& at : level.texture.coordinates[t]) out.bytes(glm::vec2(at.x, 1 - at.y));
        }
        if (!wedges.normals.empty()) out << '\11', out.bytes(corner_normals(mesh, wedges, t));
        if (!wedges.colours.empty()) out << '\11', out.bytes(in_bytes(corner_colours(mesh, wedges, t)));
    }
    return out.flush();
}

} // namespace glcast::format
