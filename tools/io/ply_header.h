// What the header of a .ply says.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/io/text_cursor.h"

namespace glcast::format::ply {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Encoding { ascii, little, big };

std::size_t size_of(Type type); ///< bytes
inline bool is_whole(Type type) { return type != Type::f32 && type != Type::f64; }

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

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::string picture; ///< named by `comment TextureFile`
    bool ours = false;   ///< written by glcast
};

/// Leaves the cursor at the body. Throws std::runtime_error.
Header read_header(TextCursor& cursor);

/// Lists of a face with three numbers a corner: the second as MeshLab has it, the first ours in the same manner.
inline constexpr std::string_view wedge_normals = "normal", wedge_colours = "color";

/// Where a property of a vertex or face goes.
enum Slot { x, y, z, nx, ny, nz, red, green, blue, place_u, place_v, slots, none = slots };
Slot slot_of(std::string_view name);

/// Does OpenMesh 9 read a file with this header as it is meant? It has floats alone, takes a list of vertices for a number, cuts colours
/// that are floats to 8 bits, knows no strips, and reads nothing behind the faces.
bool openmesh_reads(const Header& header);

/// The header again, without what readers may take for something else: OpenMesh looks for its end for ever.
std::string plain_header(const Header& header);

/// Do floats hold all numbers of a text, and are they numbers all?
bool floats_hold(std::string_view body);

} // namespace glcast::format::ply
