// 3D Manufacturing Format (.3mf), read by lib3mf in a child process: what is to be built, with its transforms, as one mesh.
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "tools/io/mesh_format.h"
#include "tools/io/reader_process.h"
#include "tools/io/soup.h"
#include "tools/io/threemf_handle.h"

namespace glcast::format {
namespace {

using namespace NMR;
using Handle = ThreeMfHandle;

constexpr const char* damaged = "lib3mf cannot read it";
constexpr int deepest = 64;                       ///< components of components
constexpr std::size_t always = 100'000, for_a_byte = 32; ///< vertices and triangles that a file may make
constexpr glm::vec3 no_colour(0.8f);              ///< of what has none beside others that have

void good(LIB3MFRESULT result) { require(result, damaged); }

glm::dmat4 matrix_of(const MODELTRANSFORM& from) {
    glm::dmat4 m(1);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) m[column][row] = from.m_fFields[row][column];
    return m;
}

glm::vec3 colour_of(BYTE red, BYTE green, BYTE blue) { return glm::vec3(red, green, blue) / 255.0f; }

class Model {
  public:
    Model(std::string_view bytes) : left(always + for_a_byte * bytes.size()) {
        good(lib3mf_createmodel(&model.of));
        Handle reader;
        good(lib3mf_model_queryreader(model.of, "3mf", &reader.of));
        auto* const first = reinterpret_cast<BYTE*>(const_cast<char*>(bytes.data())); // nothing writes through it
        good(lib3mf_reader_readfrombuffer(reader.of, first, bytes.size()));
    }

    Soup soup_of_build() {
        Handle items;
        good(lib3mf_model_getbuilditems(model.of, &items.of));
        for (BOOL there = false; good(lib3mf_builditemiterator_movenext(items.of, &there)), there;) {
            Handle item, object;
            good(lib3mf_builditemiterator_getcurrent(items.of, &item.of));
            good(lib3mf_builditem_getobjectresource(item.of, &object.of));
            MODELTRANSFORM transform{};
            good(lib3mf_builditem_getobjecttransform(item.of, &transform));
            add_object(object.of, matrix_of(transform), 0);
        }
        if (!coloured) soup.corner_colours.clear();
        return std::move(soup);
    }

  private:
    void take(std::size_t count) {
        if (count > left) refuse("makes more vertices and triangles of its bytes than is read: 100,000 and 32 a byte");
        left -= count;
    }

    void add_object(PLib3MFBase* object, const glm::dmat4& place, int depth) {
        if (depth > deepest) refuse("its components are nested too deep");
        BOOL is_mesh = false;
        good(lib3mf_object_ismeshobject(object, &is_mesh));
        if (is_mesh) return add_mesh(object, place);
        DWORD count = 0;
        good(lib3mf_componentsobject_getcomponentcount(object, &count));
        take(count);
        for (DWORD k = 0; k < count; ++k) {
            Handle component, part;
            good(lib3mf_componentsobject_getcomponent(object, k, &component.of));
            good(lib3mf_component_getobjectresource(component.of, &part.of));
            MODELTRANSFORM transform{};
            good(lib3mf_component_gettransform(component.of, &transform));
            add_object(part.of, place * matrix_of(transform), depth + 1);
        }
    }

    void add_mesh(PLib3MFBase* mesh, const glm::dmat4& place) {
        DWORD vertices = 0, triangles = 0;
        good(lib3mf_meshobject_getvertexcount(mesh, &vertices));
        good(lib3mf_meshobject_gettrianglecount(mesh, &triangles));
        take(std::size_t(vertices) + triangles);
        const std::size_t base = soup.positions.size();
        for (DWORD v = 0; v < vertices; ++v) {
            MODELMESHVERTEX vertex;
            good(lib3mf_meshobject_getvertex(mesh, v, &vertex));
            const FLOAT* const p = vertex.m_fPosition;
            soup.positions.emplace_back(place * glm::dvec4(p[0], p[1], p[2], 1));
        }
        const bool mirrored = glm::determinant(glm::dmat3(place)) < 0; // what was outside stays so
        Handle properties, whole;
        good(lib3mf_meshobject_createpropertyhandler(mesh, &properties.of));
        good(lib3mf_object_createdefaultpropertyhandler(mesh, &whole.of));
        const std::optional<glm::vec3> otherwise = default_colour(whole.of);
        for (DWORD t = 0; t < triangles; ++t) {
            MODELMESHTRIANGLE triangle;
            good(lib3mf_meshobject_gettriangle(mesh, t, &triangle));
            const std::array<glm::vec3, 3> colours = triangle_colours(properties.of, t, otherwise);
            soup.begin_face();
            for (const int k : {0, mirrored ? 2 : 1, mirrored ? 1 : 2}) {
                soup.corner(std::uint32_t(base + triangle.m_nIndices[k]));
                soup.corner_colours.push_back(colours[std::size_t(k)]);
            }
        }
    }

    std::optional<glm::vec3> base_material(DWORD group, DWORD index) {
        Handle material;
        BYTE red = 0, green = 0, blue = 0, alpha = 0;
        if (group == 0 || lib3mf_model_getbasematerialbyid(model.of, group, &material.of) != 0 ||
            lib3mf_basematerial_getdisplaycolor(material.of, index, &red, &green, &blue, &alpha) != 0)
            return {};
        coloured = true;
        return colour_of(red, green, blue);
    }

    /// Of what has no colour of its own.
    std::optional<glm::vec3> default_colour(PLib3MFBase* whole) {
        eModelPropertyType kind = MODELPROPERTYTYPE_NONE;
        good(lib3mf_defaultpropertyhandler_getpropertytype(whole, &kind));
        if (kind == MODELPROPERTYTYPE_BASEMATERIALS) {
            DWORD group = 0, index = 0;
            good(lib3mf_defaultpropertyhandler_getbasematerial(whole, &group, &index));
            return base_material(group, index);
        }
        if (kind != MODELPROPERTYTYPE_COLOR) return {};
        MODELMESHCOLOR_SRGB colour{};
        good(lib3mf_defaultpropertyhandler_getcolor(whole, 0, &colour));
        coloured = true;
        return colour_of(colour.m_Red, colour.m_Green, colour.m_Blue);
    }

    std::array<glm::vec3, 3> triangle_colours(PLib3MFBase* properties, DWORD t, const std::optional<glm::vec3>& otherwise) {
        std::array<glm::vec3, 3> colours;
        colours.fill(otherwise.value_or(no_colour));
        eModelPropertyType kind = MODELPROPERTYTYPE_NONE;
        good(lib3mf_propertyhandler_getpropertytype(properties, t, &kind));
        if (kind == MODELPROPERTYTYPE_BASEMATERIALS) {
            DWORD group = 0, index = 0;
            good(lib3mf_propertyhandler_getbasematerial(properties, t, &group, &index));
            if (const auto colour = base_material(group, index)) colours.fill(*colour);
        } else if (kind == MODELPROPERTYTYPE_COLOR) {
            MODELMESH_TRIANGLECOLOR_SRGB found{};
            good(lib3mf_propertyhandler_getcolor(properties, t, &found));
            for (std::size_t k = 0; k < 3; ++k)
                colours[k] = colour_of(found.m_Colors[k].m_Red, found.m_Colors[k].m_Green, found.m_Colors[k].m_Blue);
            coloured = true;
        }
        return colours;
    }

    Handle model;
    Soup soup;
    std::size_t left;
    bool coloured = false; ///< something is
};

} // namespace

std::vector<Level> read_3mf(std::string_view bytes, const std::filesystem::path&) {
    if (!bytes.starts_with("PK")) refuse("is no .3mf: it is no zip file");
    Soup soup = soup_of(read_apart(bytes.size(), [&] { return bytes_of(Model(bytes).soup_of_build()); }));
    if (soup.sizes.empty()) refuse("holds no triangles");
    return {level_of(std::move(soup))};
}

} // namespace glcast::format
