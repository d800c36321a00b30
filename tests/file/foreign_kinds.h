// Files as other programs write them, all of one box: volume 6, 12 triangles.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace glcast::foreign {

inline const glm::vec3 brown = glm::vec3(200, 100, 50) / 255.0f, red(1, 0, 0);

/// The box of all of them, 1 × 2 × 3.
inline const char* const places[] = {"0 0 0", "0 0 3", "0 2 0", "0 2 3", "1 0 0", "1 0 3", "1 2 0", "1 2 3"};
inline constexpr int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};

inline std::string vertices(const std::string& before, const std::string& after, const std::string& end = "\n") {
    std::string text;
    for (const char* place : places) text += before + place + after + end;
    return text;
}
inline std::string polygons(const std::string& before, int base, const std::string& after = "", const std::string& end = "\n") {
    std::string text;
    for (const auto& face : faces) {
        text += before;
        for (int k = 0; k < 4; ++k) text += (k ? " " : "") + std::to_string(face[k] + base);
        text += after + end;
    }
    return text;
}

inline std::string ply(const std::string& vertex, const std::string& face, const std::string& body,
                const std::string& list = "property list uchar int vertex_indices\n") {
    return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n" + vertex +
           "element face 6\n" + list + face + "end_header\n" + body;
}

struct Number {
    bool big;
    std::string bytes{};
    template <class T> Number& operator<<(T value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (big) std::reverse(raw, raw + sizeof value);
        bytes.append(raw, sizeof value);
        return *this;
    }
};

/// Binary; colours of vertices as T.
template <class Place, class T> std::string binary_ply(bool big, const char* place, const char* type, T r, T g, T b) {
    std::string text = std::string("ply\r\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\r\nelement vertex 8\r\n";
    for (const char* axis : {"x", "y", "z"}) text += std::string("property ") + place + " " + axis + "\r\n";
    for (const char* channel : {"red", "green", "blue"}) text += std::string("property ") + type + " " + channel + "\r\n";
    Number out{big};
    for (int v = 0; v < 8; ++v) out << Place(v / 4) << Place(v / 2 % 2 * 2) << Place(v % 2 * 3) << r << g << b;
    for (const auto& face : faces) {
        out << std::uint8_t(4);
        for (const int v : face) out << std::int32_t(v);
    }
    return text + "element face 6\r\nproperty list uint8 int32 vertex_index\r\nend_header\r\n" + out.bytes;
}

inline std::string binary_off(bool big) {
    Number out{big};
    out << std::uint32_t(8) << std::uint32_t(6) << std::uint32_t(0);
    for (int v = 0; v < 8; ++v) out << float(v / 4) << float(v / 2 % 2 * 2) << float(v % 2 * 3);
    for (const auto& face : faces) {
        out << std::uint32_t(4);
        for (const int v : face) out << std::uint32_t(v);
        out << std::uint32_t(4) << 200 / 255.0f << 100 / 255.0f << 50 / 255.0f << 1.0f;
    }
    return "OFF BINARY\n" + out.bytes;
}

template <class Facet> void each_facet(const Facet& facet) {
    for (const auto& face : faces)
        for (int k = 2; k < 4; ++k) facet(std::array{face[0], face[k - 1], face[k]});
}

inline std::string text_stl(const std::string& head, const std::string& facet, const std::string& loop, const std::string& end,
                     const std::string& last) {
    std::string text = head;
    each_facet([&](const auto& corners) {
        text += facet;
        for (const int v : corners) text += loop + places[v];
        text += end;
    });
    return text + last;
}

inline std::string binary_stl(const std::string& head, std::uint16_t attribute, const std::string& tail = "") {
    Number out{false, head};
    out.bytes.resize(80, '\0');
    out << std::uint32_t(12);
    each_facet([&](const auto& corners) {
        out << 0.0f << 0.0f << 0.0f;
        for (const int v : corners) out << float(v / 4) << float(v / 2 % 2 * 2) << float(v % 2 * 3);
        out << attribute;
    });
    return out.bytes + tail;
}

struct Kind {
    std::string file, text;
    std::optional<glm::vec3> colour{};
    double tolerance = 1e-6;
};

constexpr std::uint16_t rgb5(int r, int g, int b) { return std::uint16_t(r | g << 5 | b << 10); }
inline const glm::vec3 of_32(25 / 31.0f, 12 / 31.0f, 6 / 31.0f);

inline std::vector<Kind> kinds() {
    const std::string v = vertices("v ", ""), f = polygons("f ", 1);
    const std::string p = vertices("", ""), q = polygons("4 ", 0);
    const std::string facet = "facet normal 0 0 0\nouter loop\n", end = "\nendloop\nendfacet\n";
    return {
        {"a.obj", v + f},
        {"crlf.obj", vertices("v ", "", "\r\n") + polygons("f ", 1, "", "\r\n")},
        {"cr.obj", vertices("v ", "", "\r") + polygons("f ", 1, "", "\r")},
        {"tabs.OBJ", "\xEF\xBB\xBF# c:\\in\\\n" + vertices("\tv\t", " \t", "\n\n") + "g a b\no box\ns 1\n" + polygons("f  ", 1, " # side")},
        {"continued.obj", v + "f 1 2 \\\n 4 \\\r\n3\n" + polygons("f ", 1).substr(10)},
        {"weights.obj", vertices("v ", " 1.0") + f},
        {"bytes.obj", vertices("v ", " 200 100 50") + f, brown},
        {"parts.obj", vertices("v ", " 0.784314 0.392157 0.196078") + f, brown},
        {"alpha.obj", vertices("v ", " 0.784314 0.392157 0.196078 1") + f, brown},
        {"relative.obj", v + "f -8 -7 -5 -6\nf -4 -2 -1 -3\nf -8 -4 -3 -7\nf -6 -5 -1 -2\nf -8 -6 -2 -4\nf -7 -3 -1 -5\n"},
        {"normals.obj", v + "vn 1e-300 0 0\nvn 0 0 0\nvn nan 0 1\nvt 0 0\n" +
                            "f 1//1 2//2 4//3 3//1\nf 5/1 7/1 8/1 6/1\nf 1/1/1 5/1/2 6/1/3 2/1/1\n" +
                            polygons("f ", 1).substr(30)},
        {"no-area.obj", v + "f 1 1 2\nf 3 3 3\n" + f},
        {"faces-first.obj", f + v},
        {"ascii.ply", ply("", "", p + q)},
        {"quality.ply", ply("property float quality\n", "", vertices("", " -1.#IND") + q)},
        {"nan-normals.ply", ply("property float nx\nproperty float ny\nproperty float nz\n", "", vertices("", " nan 0 -nan(ind)") + q)},
        {"exponents.ply", ply("property double q\n", "", vertices("", " 1e-320") + q)},
        {"uchar.ply", ply("property uchar red\nproperty uchar green\nproperty uchar blue\n", "", vertices("", " 200 100 50") + q), brown},
        {"char.ply", ply("property char red\nproperty char green\nproperty char blue\n", "", vertices("", " -56 100 50") + q), brown},
        {"short.ply", ply("property short r\nproperty short g\nproperty short b\n", "", vertices("", " 200 100 50") + q), brown},
        {"ushort.ply", ply("property ushort red\nproperty ushort green\nproperty ushort blue\n", "", vertices("", " 51400 25700 12850") + q), brown},
        {"uint.ply", ply("property uint diffuse_red\nproperty uint diffuse_green\nproperty uint diffuse_blue\n", "", vertices("", " 200 100 50") + q), brown},
        {"float.ply", ply("property float red\nproperty float green\nproperty float blue\nproperty float alpha\n", "", vertices("", " .784314 .392157 .196078 1") + q), brown},
        {"float255.ply", ply("property float red\nproperty float green\nproperty float blue\n", "", vertices("", " 200 100 50") + q), brown},
        {"double.ply", ply("property double red\nproperty double green\nproperty double blue\n", "", vertices("", " .784314 .392157 .196078") + q), brown},
        {"faces-float.ply", ply("", "property float red\nproperty float green\nproperty float blue\n", p + polygons("4 ", 0, " .784314 .392157 .196078")), brown},
        {"faces-before.ply", ply("", "property list uchar int vertex_index\n", p + polygons("200 100 50 4 ", 0), "property int red\nproperty int green\nproperty int blue\n"), brown},
        {"corner-list.ply", ply("", "property list uchar uchar color\n", p + polygons("4 ", 0, " 12 200 100 50 200 100 50 200 100 50 200 100 50")), brown},
        {"lists.ply", ply("property list ushort short near\n", "property list int float x\n", vertices("", " 2 7 8") + polygons("4 ", 0, " 0"), "property list uint uint vertex_indices\n")},
        {"little.ply", binary_ply<float, std::uint8_t>(false, "float", "uchar", 200, 100, 50), brown},
        {"big.ply", binary_ply<float, std::uint8_t>(true, "float32", "uint8", 200, 100, 50), brown},
        {"doubles.ply", binary_ply<double, float>(true, "double", "float", 200 / 255.0f, 100 / 255.0f, 50 / 255.0f), brown},
        {"ushorts.ply", binary_ply<std::int16_t, std::uint16_t>(false, "short", "ushort", 51400, 25700, 12850), brown},
        {"ints.ply", binary_ply<float, std::int32_t>(false, "float", "int", 200, 100, 50), brown},
        {"strips.ply", "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                       "element tristrips 2\nproperty list int int vertex_indices\nend_header\n" + p +
                       "15 0 1 2 3 -1 4 6 5 7 -1 0 4 1 5 -1\n14 2 3 6 7 -1 0 2 4 6 -1 1 5 3 7\n"},
        {"a.off", "OFF\n8 6 12\n" + p + q},
        {"comment.off", "# of\n\nOFF # box\r\n8 6 0 # counts\n" + vertices("", " # v", "\r\n") + q},
        {"no-keyword.off", "8 6 12\n" + p + q},
        {"two-counts.off", "OFF\n8 6\n" + p + q},
        {"one-line.off", "OFF 8 6 12 " + vertices(" ", "", " ") + polygons(" 4 ", 0, "", " ")},
        {"coff.off", "COFF\n8 6 12\n" + vertices("", " 200 100 50 255") + q, brown},
        {"coff3.off", "COFF\n8 6 12\n" + vertices("", " 200 100 50") + q, brown},
        {"coff-parts.off", "COFF\n8 6 12\n" + vertices("", " .784314 .392157 .196078 1") + q, brown},
        {"noff.off", "NOFF\n8 6 12\n" + vertices("", " 0 0 0") + q},
        {"cnoff.off", "CNOFF\n8 6 12\n" + vertices("", " 0 0 1 200 100 50 255") + q, brown},
        {"stoff.off", "STOFF\n8 6 12\n" + vertices("", " 0.5 0.5") + q},
        {"stcnoff.off", "STCNOFF\n8 6 12\n" + vertices("", " 0 0 1 200 100 50 255 0.5 0.5") + q, brown},
        {"4.off", "4OFF\n8 6 12\n" + vertices("", " 1") + q},
        {"extra.off", "OFF\n8 6 12\n" + vertices("", " 200 100 50 255") + q, brown},
        {"faces.off", "OFF\n8 6 12\n" + p + polygons("4 ", 0, " 0.784314 0.392157 0.196078"), brown},
        {"faces4.off", "OFF\n8 6 12\n" + p + polygons("4 ", 0, "\t200 100 50 255"), brown},
        {"faces-red.off", "OFF\n8 6 12\n" + p + polygons("4 ", 0, " 1 0 0"), red},
        {"map.off", "OFF\n8 6 12\n" + p + polygons("4 ", 0, " 7")},
        {"binary.off", binary_off(true), brown},
        {"binary-little.off", binary_off(false), brown},
        {"a.stl", text_stl("solid outer facet\n", facet, "\nvertex ", end, "endsolid outer facet\n")},
        {"crlf.STL", text_stl("\r\n  SOLID\r\n", "\tFACET NORMAL nan 0 0\r\nOUTER LOOP", "\r\nVERTEX\t", "\r\nENDLOOP\r\nENDFACET\r\n", "ENDSOLID")},
        {"split.stl", text_stl("solid\n", "facet outer loop", " vertex ", " end loop end facet\n", "end solid\n")},
        {"solids.stl", "solid none\nendsolid\n" + text_stl("solid a\n", facet, "\nvertex ", end, "endsolid a\nsolid b\nendsolid b\n")},
        {"no-area.stl", text_stl("solid\n" + facet + "vertex 1 1 1\nvertex 1 1 1\nvertex 0 0 0" + end, facet, "\nvertex ", end, "endsolid\n")},
        {"binary.stl", binary_stl("made by", 0)},
        {"binary-solid.stl", binary_stl("solid facet", 0)},
        {"appended.stl", binary_stl("x", 0, "more")},
        {"viscam.stl", binary_stl("x", std::uint16_t(0x8000 | rgb5(6, 12, 25))), of_32},
        {"magics.stl", binary_stl(std::string("COLOR=\xff\xff\xff\xff", 10), rgb5(25, 12, 6)), of_32},
        {"magics-whole.stl", binary_stl(std::string("COLOR=\xc8\x64\x32\xff", 10), 0x8000), brown},
    };
}

} // namespace glcast::foreign
