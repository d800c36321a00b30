// 3D Manufacturing Format (.3mf), written by lib3mf: one object with its unit, and a colour group for the
// colours of its corners.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/io/mesh_format.h"
#include "tools/io/threemf_handle.h"

namespace glcast::format {
namespace {

using namespace NMR;

constexpr DWORD units_of_lib3mf[] = {MODELUNIT_MICROMETER, MODELUNIT_MILLIMETER, MODELUNIT_CENTIMETER,
                                     MODELUNIT_INCH,       MODELUNIT_FOOT,       MODELUNIT_METER};
static_assert(std::size(units_of_lib3mf) == length_units.size());

using Handle = ThreeMfHandle;

void require(LIB3MFRESULT result) { format::require(result, "lib3mf cannot make the .3mf"); }

/// lib3mf writes six decimals: where these are too coarse, a smaller unit, the same length.
std::size_t unit_for(const Mesh& mesh, std::size_t asked) {
    const double size = diagonal(mesh) * length_units[asked].millimetres;
    for (const std::size_t unit : {asked, millimetre, std::size_t(0)})
        if (size >= length_units[unit].millimetres &&
            length_units[unit].millimetres <= length_units[asked].millimetres)
            return unit;
    return 0;
}

void add_geometry(PLib3MFBase* object, const Mesh& mesh, const glm::dvec3& from, double scale) {
    std::vector<MODELMESHVERTEX> vertices(mesh.positions.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int k = 0; k < 3; ++k)
            vertices[v].m_fPosition[k] = static_cast<float>((mesh.positions[v][k] - from[k]) * scale);
    std::vector<MODELMESHTRIANGLE> triangles(mesh.triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        std::copy(mesh.triangles[t].begin(), mesh.triangles[t].end(), triangles[t].m_nIndices);
    require(lib3mf_meshobject_setgeometry(object, vertices.data(), static_cast<DWORD>(vertices.size()),
                                          triangles.data(), static_cast<DWORD>(triangles.size())));
}

MODELMESHCOLOR_SRGB bytes_of(const glm::vec3& colour) {
    const auto channel = [](float value) {
        return static_cast<BYTE>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
    };
    return {channel(colour.x), channel(colour.y), channel(colour.z), 255};
}

void add_colours(PLib3MFBase* object, const Level& level) {
    if (!has_colours(level.mesh, level.wedges)) return;
    std::vector<MODELMESH_TRIANGLECOLOR_SRGB> colours(level.mesh.triangles.size());
    for (std::size_t t = 0; t < colours.size(); ++t) {
        const auto corners = corner_colours(level.mesh, level.wedges, t);
        for (int k = 0; k < 3; ++k) colours[t].m_Colors[k] = bytes_of(corners[k]);
    }
    Handle handler, whole;
    require(lib3mf_meshobject_createpropertyhandler(object, &handler.of));
    require(lib3mf_propertyhandler_setgradientcolorarray(handler.of, colours.data()));
    require(lib3mf_object_createdefaultpropertyhandler(object, &whole.of));
    const MODELMESHCOLOR_SRGB first = colours[0].m_Colors[0];
    require(lib3mf_defaultpropertyhandler_setcolorrgb(whole.of, first.m_Red, first.m_Green, first.m_Blue));
}

/// So that the same model makes the same file: lib3mf would take them at random.
constexpr const char *object_uuid = "6b1d9c1e-6c67-4a51-8d7c-676c63617301",
                     *item_uuid = "6b1d9c1e-6c67-4a51-8d7c-676c63617302",
                     *build_uuid = "6b1d9c1e-6c67-4a51-8d7c-676c63617303";

std::vector<BYTE> bytes_of_model(PLib3MFBase* model) {
    Handle writer;
    ULONG64 size = 0;
    require(lib3mf_model_querywriter(model, "3mf", &writer.of));
    require(lib3mf_writer_getstreamsize(writer.of, &size));
    std::vector<BYTE> bytes(size);
    require(lib3mf_writer_writetobuffer(writer.of, bytes.data(), size));
    return bytes;
}

} // namespace

bool write_3mf(FileSet& files, const std::filesystem::path& path, const Level& level,
               const WriteOptions& options) {
    const std::size_t unit = unit_for(level.mesh, options.units);
    const double scale = length_units[options.units].millimetres / length_units[unit].millimetres;
    const glm::dvec3 from = origin_of_floats(level.mesh);
    Handle model, object, item;
    require(lib3mf_createmodel(&model.of));
    require(lib3mf_model_setunit(model.of, units_of_lib3mf[unit]));
    require(lib3mf_model_addmeshobject(model.of, &object.of));
    require(lib3mf_object_setnameutf8(object.of, path.stem().c_str()));
    add_geometry(object.of, level.mesh, from, scale);
    add_colours(object.of, level);
    // No transform: lib3mf writes six digits of it, too few for places that are far away.
    require(lib3mf_model_addbuilditem(model.of, object.of, nullptr, &item.of));
    require(lib3mf_object_setuuidutf8(object.of, object_uuid));
    require(lib3mf_builditem_setuuidutf8(item.of, item_uuid));
    require(lib3mf_model_setbuilduuidutf8(model.of, build_uuid));
    const std::vector<BYTE> bytes = bytes_of_model(model.of);
    return files.mesh(path).append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

} // namespace glcast::format
