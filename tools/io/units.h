// What a unit of a model is in the world, for the formats that printers take.
#pragma once
#include <array>
#include <string_view>

namespace glcast {

struct LengthUnit {
    std::string_view name;       ///< as --units has it
    std::string_view of_3mf;     ///< as a .3mf has it
    double millimetres;
};

/// Finest first.
inline constexpr std::array<LengthUnit, 6> length_units = {{{"um", "micron", 0.001},
                                                            {"mm", "millimeter", 1},
                                                            {"cm", "centimeter", 10},
                                                            {"inch", "inch", 25.4},
                                                            {"ft", "foot", 304.8},
                                                            {"m", "meter", 1000}}};
inline constexpr std::size_t millimetre = 1; ///< of length_units: where nobody says

/// Of a name, as an index of length_units; length_units.size() when there is none.
inline std::size_t length_unit(std::string_view name) {
    std::size_t k = 0;
    while (k < length_units.size() && name != length_units[k].name) ++k;
    return k;
}

} // namespace glcast
