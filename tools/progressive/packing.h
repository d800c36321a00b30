// How numbers become few bytes, and come back bit for bit. Internal.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace glcast::progressive {

template <class Float> using Bits = std::conditional_t<sizeof(Float) == 8, std::uint64_t, std::uint32_t>;

/// Integers in the order of the numbers, so that near numbers have a small difference; every bit pattern has
/// its own.
template <class Float> Bits<Float> ordered(Float value) {
    constexpr auto sign = Bits<Float>(1) << (8 * sizeof(Float) - 1);
    const auto bits = std::bit_cast<Bits<Float>>(value);
    return bits & sign ? ~bits : bits | sign;
}

template <class Float> Float from_ordered(Bits<Float> order) {
    constexpr auto sign = Bits<Float>(1) << (8 * sizeof(Float) - 1);
    return std::bit_cast<Float>(order & sign ? order & ~sign : ~order);
}

/// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
template <class U> U zigzag(U difference) {
    return U(difference << 1) ^ (difference >> (8 * sizeof(U) - 1) ? U(~U(0)) : U(0));
}
template <class U> U unzigzag(U z) { return U(z >> 1) ^ (z & 1 ? U(~U(0)) : U(0)); }

template <class Float> Bits<Float> difference(Float value, Float expected) {
    return zigzag(Bits<Float>(ordered(value) - ordered(expected)));
}
template <class Float> Float with_difference(Bits<Float> z, Float expected) {
    return from_ordered<Float>(Bits<Float>(ordered(expected) + unzigzag(z)));
}

/// Bytes, and where one kind of them ends and the next begins.
struct Planes {
    std::string bytes;
    std::vector<std::size_t> ends;
};

/// Appends the numbers as planes: the highest bytes of all, then the next lower ones, ...
template <class U> void put_planes(Planes& planes, const std::vector<U>& column) {
    for (int shift = 8 * sizeof(U) - 8; shift >= 0; shift -= 8) {
        for (const U value : column) planes.bytes.push_back(char(std::uint8_t(value >> shift)));
        planes.ends.push_back(planes.bytes.size());
    }
}

/// Reads what was put together from columns. Throws std::runtime_error where there is less than asked for.
class ColumnReader {
  public:
    explicit ColumnReader(std::string_view bytes) : rest(bytes) {}

    std::string_view take(std::size_t count) {
        if (count > rest.size()) throw std::runtime_error("it holds less than it says");
        const std::string_view taken = rest.substr(0, count);
        rest.remove_prefix(count);
        return taken;
    }
    std::size_t left() const { return rest.size(); }

    template <class U> std::vector<U> planes(std::size_t count) {
        if (count > rest.size())
            throw std::runtime_error("it holds less than it says"); // before memory is asked for
        const std::string_view bytes = take(count * sizeof(U));
        std::vector<U> column(count);
        for (std::size_t plane = 0; plane < sizeof(U); ++plane)
            for (std::size_t k = 0; k < count; ++k)
                column[k] = U(U(column[k] << 7 << 1) | std::uint8_t(bytes[plane * count + k]));
        return column;
    }

  private:
    std::string_view rest;
};

/// By zlib, without looking for repetitions further than the last byte: what is packed here is noise or runs.
/// Each plane that is long enough has a code of its own.
std::string packed(const Planes& planes);

/// Throws std::runtime_error where it is not exactly `size` bytes; asks for memory only as it fills it.
std::string unpacked(std::string_view bytes, std::uint64_t size);

std::uint32_t checksum(std::string_view bytes); ///< CRC-32 as of zlib

} // namespace glcast::progressive
