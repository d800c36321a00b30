// The attributes of an OpenEXR header, each of the length that its type has.
#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/exr_header.h"

namespace glcast::exr {

/// Attributes of one part by name.
using Attributes = std::map<std::string_view, Attribute>;

/// All headers of a multi-part file. `offset` is where the first begins, and then where the offset tables do.
/// Every attribute is of a type that is known here and fills its stated length exactly, so no reader that
/// goes by types, as OpenEXR does, can see another header than one that goes by lengths. None comes twice,
/// none means tiles, deep pixels or a preview. `most_parts` bounds their number. Throws std::runtime_error
/// without the file's name. What is returned points into `bytes`.
std::vector<Attributes> read_headers(std::span<const char> bytes, std::size_t& offset,
                                     std::size_t most_parts);

// Values by name; each throws std::runtime_error where there is none of that name and type.
int int_value(const Attributes& header, std::string_view name);
double double_value(const Attributes& header, std::string_view name);
unsigned char byte_value(const Attributes& header, std::string_view name); ///< compression, lineOrder
std::string string_value(const Attributes& header, std::string_view name);
std::vector<std::string> strings_value(const Attributes& header, std::string_view name);
/// `count` numbers of type int or double, as "v3d" has.
std::vector<int> ints_value(const Attributes& header, std::string_view name, std::string_view type);
std::vector<double> doubles_value(const Attributes& header, std::string_view name, std::string_view type);

struct ChannelType {
    std::string name;
    int type = 0; ///< 0 whole number of 32 bits, 1 half, 2 float
    int x_sampling = 0, y_sampling = 0;
};
std::vector<ChannelType> channels_value(const Attributes& header, std::string_view name);

} // namespace glcast::exr
