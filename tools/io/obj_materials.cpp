#include "tools/io/obj_materials.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "tools/io/beside.h"
#include "tools/io/text_cursor.h"
#include "tools/picture/png.h"
#include "tools/picture/sample.h"

namespace glcast::format {
namespace {

constexpr std::size_t largest_library = 64u << 20, largest_picture_file = 256u << 20;

struct Described {
    std::optional<glm::vec3> colour;
    std::string picture;
};

/// The file name behind options such as `-s 1 1 1` and `-clamp on`.
std::string_view picture_name(std::string_view rest) {
    rest = TextCursor::trimmed(rest);
    while (rest.starts_with('-')) {
        TextCursor::word(rest);
        for (;;) {
            std::string_view after = rest;
            const std::string_view value = TextCursor::word(after);
            double number = 0;
            if (value != "on" && value != "off" && !TextCursor::parse(value, number)) break;
            rest = after;
        }
        rest = TextCursor::trimmed(rest);
    }
    return rest;
}

void describe(std::string_view bytes, std::map<std::string, Described, std::less<>>& all) {
    TextCursor cursor(bytes);
    Described* now = nullptr;
    std::string_view line;
    while (cursor.next_line(line)) {
        const std::string_view what = TextCursor::word(line);
        if (what == "newmtl") now = &all[std::string(TextCursor::trimmed(line))];
        if (!now) continue;
        if (what == "Kd") {
            glm::dvec3 kd;
            int count = 0;
            while (count < 3 && TextCursor::parse(TextCursor::word(line), kd[count])) ++count;
            if (count == 1) kd.y = kd.z = kd.x; // the others are the same then
            if (count == 1 || count == 3) now->colour = glm::vec3(kd);
        }
        if (what == "map_Kd") now->picture = picture_name(line);
    }
}

/// Empty when there is none or it is damaged.
Picture picture_beside(const std::filesystem::path& mesh, const std::string& name) {
    try {
        if (const auto bytes = read_beside(mesh, name, largest_picture_file)) return decode_picture(*bytes);
    } catch (const std::runtime_error&) { // as if it were not there
    }
    return {};
}

} // namespace

glm::vec3 Material::at(const glm::vec2& place) const {
    if (!picture.rgb.empty() && std::isfinite(place.x) && std::isfinite(place.y))
        return sample(picture, {place.x - std::floor(place.x), 1 - (place.y - std::floor(place.y))});
    return colour.value_or(glm::vec3(1));
}

std::vector<Material> read_materials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
                                     const std::vector<std::string>& names) {
    std::map<std::string, Described, std::less<>> described;
    for (const std::string& library : libraries)
        if (const auto bytes = read_beside(mesh, library, largest_library)) describe(*bytes, described);
    std::vector<Material> materials(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        const auto found = described.find(names[k]);
        if (found == described.end()) continue;
        materials[k].colour = found->second.colour;
        if (!found->second.picture.empty())
            materials[k].picture = picture_beside(mesh, found->second.picture);
    }
    return materials;
}

Material picture_material(const std::filesystem::path& mesh, const std::string& picture) {
    return {std::nullopt, picture_beside(mesh, picture)};
}

} // namespace glcast::format
