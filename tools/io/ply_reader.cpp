// .ply, ASCII and binary of both byte orders: by OpenMesh where it reads the file as it is meant; else any elements and
// properties, of which vertices, faces and triangle strips are taken.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "tools/io/beside.h"
#include "tools/io/mesh_format.h"
#include "tools/io/obj_materials.h"
#include "tools/io/openmesh_reader.h"
#include "tools/io/ply_header.h"
#include "tools/picture/png.h"

namespace glcast::format {
namespace {

using namespace ply;

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
            return double(take<float>());
        case Type::f64:
            return take<double>();
        }
        return 0;
    }
    /// Of a list, or 1.
    std::size_t length(const Property& property) {
        if (!property.list) return 1;
        const double length = next(*property.list);
        if (!(length >= 0) || length > double(left())) refuse("a list is longer than the file");
        return static_cast<std::size_t>(length);
    }
    void skip(const Property& property) {
        for (std::size_t count = length(property); count > 0; --count) next(property.type);
    }
    /// Past so many bytes, or words of a text.
    void jump(std::size_t bytes) {
        for (; encoding == Encoding::ascii && bytes > 0; --bytes) next_word();
        if (bytes > rest.size()) refuse("the file is truncated");
        rest.remove_prefix(bytes);
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

/// Properties with a slot, and which slots there are.
struct Layout {
    std::vector<Slot> of;
    bool has[slots + 1] = {};
    bool whole_colours = false, byte_colours = false;

    explicit Layout(const Element& element) {
        for (const Property& p : element.properties) {
            of.push_back(p.list ? none : slot_of(p.name));
            has[of.back()] = true;
            if (of.back() != red) continue;
            whole_colours = is_whole(p.type);
            byte_colours = size_of(p.type) == 1;
        }
    }
    bool positions() const { return has[x] && has[y] && has[z]; }
    bool normals() const { return has[nx] && has[ny] && has[nz]; }
    bool colours() const { return has[red] && has[green] && has[blue]; }
    bool places() const { return has[place_u] && has[place_v]; }
    glm::vec3 colour(const double* slot) const {
        glm::dvec3 c(slot[red], slot[green], slot[blue]);
        for (int k = 0; k < 3 && byte_colours; ++k) c[k] += c[k] < 0 ? 256 : 0; // a char is a byte all the same
        return c;
    }
};

class PlyReader {
  public:
    PlyReader(const Header& header, std::string_view body) : header(header), values(body, header.encoding) {}

    Soup read() {
        for (const Element& element : header.elements) {
            if (element.properties.empty()) continue;
            if (element.count > values.left()) refuse("the file is truncated, or its counts are wrong");
            if (element.name == "vertex")
                vertices(element);
            else if (element.name == "face" || element.name == "tristrips")
                faces(element, element.name == "tristrips");
            else
                for (std::size_t k = 0; k < element.count; ++k)
                    for (const Property& p : element.properties) values.skip(p);
        }
        finish();
        return std::move(soup);
    }

  private:
    void vertices(const Element& element) {
        const Layout layout(element);
        if (!layout.positions()) refuse("its vertices have no x, y and z");
        vertex_whole = layout.whole_colours;
        for (std::size_t v = 0; v < element.count; ++v) {
            double slot[slots + 1] = {};
            for (std::size_t k = 0; k < layout.of.size(); ++k)
                if (layout.of[k] == none)
                    values.skip(element.properties[k]);
                else
                    slot[layout.of[k]] = values.next(element.properties[k].type);
            soup.positions.emplace_back(slot[x], slot[y], slot[z]);
            if (layout.normals()) soup.normals.emplace_back(slot[nx], slot[ny], slot[nz]);
            if (layout.colours()) soup.colours.push_back(layout.colour(slot));
            if (layout.places()) places.emplace_back(slot[place_u], slot[place_v]);
        }
    }

    static bool of_corners(const Property& p) {
        return p.list && (p.name == "vertex_indices" || p.name == "vertex_index" || p.name == "vertex_indexes");
    }

    void faces(const Element& element, bool strips) {
        const Layout layout(element);
        face_whole = layout.whole_colours;
        std::vector<double> corners, texcoord, normal, colour;
        for (std::size_t f = 0; f < element.count; ++f) {
            double slot[slots + 1] = {};
            corners.clear(), texcoord.clear(), normal.clear(), colour.clear();
            for (std::size_t k = 0; k < layout.of.size(); ++k) {
                const Property& p = element.properties[k];
                std::vector<double>* const list = of_corners(p)                           ? &corners
                                                  : !p.list                               ? nullptr
                                                  : p.name == "texcoord"                  ? &texcoord
                                                  : p.name == wedge_normals               ? &normal
                                                  : p.name == wedge_colours               ? &colour
                                                                                          : nullptr;
                if (list) {
                    if (list == &colour) corner_whole = is_whole(p.type);
                    for (std::size_t count = values.length(p); count > 0; --count) list->push_back(values.next(p.type));
                } else if (layout.of[k] == none)
                    values.skip(p);
                else
                    slot[layout.of[k]] = values.next(p.type);
            }
            const std::size_t before = soup.sizes.size();
            if (strips)
                strip(corners);
            else {
                face(corners, texcoord);
                if (soup.sizes.size() > before) {
                    add_corners(soup.corner_normals, normal, corners.size());
                    add_corners(soup.corner_colours, colour, corners.size());
                }
            }
            if (layout.colours()) soup.face_colours.resize(before, glm::vec3(1)), soup.face_colours.resize(soup.sizes.size(), layout.colour(slot));
        }
    }

    std::uint32_t vertex(double value) const {
        if (!(value >= 0) || value > UINT32_MAX || value != std::floor(value)) refuse("a face has an impossible corner");
        return static_cast<std::uint32_t>(value);
    }

    void face(const std::vector<double>& corners, const std::vector<double>& texcoord) {
        if (corners.size() < 3) return;
        soup.begin_face();
        const bool placed = texcoord.size() == 2 * corners.size();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            soup.corner(vertex(corners[k]));
            soup.corner_places.emplace_back(placed ? texcoord[2 * k] : no_place, placed ? texcoord[2 * k + 1] : no_place);
        }
    }

    /// Three numbers a corner. A list that some face lacks is given up.
    void add_corners(std::vector<glm::vec3>& list, const std::vector<double>& numbers, std::size_t corners) {
        if (numbers.size() != 3 * corners || list.size() != soup.corners.size() - corners) return;
        for (std::size_t k = 0; k < numbers.size(); k += 3) list.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    }

    /// Every second triangle turns the other way; -1 begins anew.
    void strip(const std::vector<double>& corners) {
        std::size_t from = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            if (corners[k] < 0) from = k + 1;
            if (k < from + 2) continue;
            const bool turned = (k - from) % 2 == 1;
            face({corners[k - 2 + (turned ? 1 : 0)], corners[k - 1 - (turned ? 1 : 0)], corners[k]}, {});
        }
    }

    void finish() {
        scale_colours(soup.colours, vertex_whole);
        if (!soup.face_colours.empty()) soup.face_colours.resize(soup.sizes.size(), glm::vec3(1));
        scale_colours(soup.face_colours, face_whole);
        scale_colours(soup.corner_colours, corner_whole);
        for (std::vector<glm::vec3>* list : {&soup.corner_normals, &soup.corner_colours})
            if (list->size() != soup.corners.size()) list->clear();
        for (std::size_t at = 0; at < soup.corners.size() && !places.empty(); ++at)
            if (soup.corners[at] < places.size() && !std::isfinite(soup.corner_places[at].x))
                soup.corner_places[at] = places[soup.corners[at]];
    }

    static constexpr double no_place = std::numeric_limits<float>::quiet_NaN();
    const Header& header;
    Values values;
    Soup soup;
    std::vector<glm::vec2> places; ///< of vertices
    bool vertex_whole = false, face_whole = false, corner_whole = false;
};

/// OpenMesh believes all counts.
void check_lengths(const Header& header, std::string_view body) {
    const Element &vertex = header.elements[0], &face = header.elements[1];
    const bool text = header.encoding == Encoding::ascii;
    std::size_t stride = 0, rest = 0; // bytes, or words of a text
    for (const Property& p : vertex.properties) stride += text ? 1 : size_of(p.type);
    for (const Property& p : face.properties) rest += p.list ? 0 : text ? 1 : size_of(p.type);
    if (vertex.count > body.size() / std::max<std::size_t>(stride, 1)) refuse("the file is truncated");
    const Property& corners = face.properties[0];
    Values values(body, header.encoding);
    values.jump(stride * vertex.count);
    for (std::size_t f = 0; f < face.count; ++f)
        values.jump(values.length(corners) * (text ? 1 : size_of(corners.type)) + rest);
}

Soup by_openmesh(const Header& header, std::string_view body) {
    check_lengths(header, body);
    Soup soup = read_with_openmesh(plain_header(header).append(body), OpenMeshKind::ply);
    if (soup.positions.size() != header.elements[0].count || soup.sizes.size() != header.elements[1].count)
        refuse("the file is truncated, or its counts are wrong");
    return soup;
}

/// The colours of a picture, where there are no others.
void show_picture(const Header& header, const std::filesystem::path& path, Soup& soup) {
    if (header.picture.empty() || !soup.colours.empty() || !soup.face_colours.empty() || !soup.corner_colours.empty()) return;
    const Material shown = picture_material(path, header.picture);
    if (shown.empty() || soup.corner_places.empty()) return;
    for (const glm::vec2& place : soup.corner_places) soup.corner_colours.push_back(shown.at(place));
}

} // namespace

std::vector<Level> read_ply(std::string_view bytes, const std::filesystem::path& path) {
    TextCursor cursor(bytes);
    const Header header = read_header(cursor);
    const std::string_view body = cursor.remaining();
    std::size_t least = 0;
    for (const Element& element : header.elements) least += std::min(element.count, bytes.size() + 1);
    if (least > bytes.size()) refuse("the file is truncated, or its counts are wrong");
    const bool others = openmesh_reads(header) && (header.encoding != Encoding::ascii || floats_hold(body));
    Soup soup = others ? by_openmesh(header, body) : PlyReader(header, body).read();
    show_picture(header, path, soup);
    return {level_of(std::move(soup))};
}

} // namespace glcast::format
