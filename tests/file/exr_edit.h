// A capture taken apart and put together again with another header: for tests of what must be refused.
#pragma once
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "capture/exr_header.h"

namespace glcast::samples {

struct RawAttribute {
    std::string name, type, value;
    std::uint32_t stated = 0; ///< length that the file gives
};

/// Headers as lists of attributes, offset tables, and chunks as they are.
struct RawCapture {
    std::vector<std::vector<RawAttribute>> parts;
    std::vector<std::uint64_t> offsets; ///< from the start of `chunks`
    std::string chunks;

    explicit RawCapture(const std::string& bytes) {
        std::size_t at = 8, chunk_count = 0;
        while (bytes.at(at) != 0) {
            parts.emplace_back();
            for (exr::Attribute a;;) {
                if (!exr::next_attribute(bytes, at, a)) throw std::logic_error("no capture to begin with");
                if (a.name.empty()) break;
                parts.back().push_back({std::string(a.name), std::string(a.type),
                                        std::string(a.value.begin(), a.value.end()),
                                        std::uint32_t(a.value.size())});
                if (a.name == "chunkCount") chunk_count += exr::read_u32(a.value.data());
            }
        }
        ++at;
        const std::size_t data = at + 8 * chunk_count;
        for (std::size_t k = 0; k < chunk_count; ++k)
            offsets.push_back(exr::read_u64(bytes.data() + at + 8 * k) - data);
        chunks = bytes.substr(data);
    }

    std::string bytes() const {
        exr::Bytes to;
        to.u32(exr::magic), to.u32(exr::version_multipart);
        for (const auto& part : parts) {
            for (const RawAttribute& a : part) {
                to.text(a.name), to.text(a.type), to.u32(a.stated);
                to.raw(a.value.data(), a.value.size());
            }
            to.data.push_back(0);
        }
        to.data.push_back(0);
        const std::uint64_t data = to.data.size() + 8 * offsets.size();
        for (std::uint64_t offset : offsets) to.u64(offset + data);
        to.raw(chunks.data(), chunks.size());
        return {to.data.begin(), to.data.end()};
    }

    RawAttribute& attribute(std::size_t part, const std::string& name) {
        const auto found = std::find_if(parts[part].begin(), parts[part].end(),
                                        [&](const auto& a) { return a.name == name; });
        if (found == parts[part].end()) throw std::logic_error("no attribute " + name);
        return *found;
    }
    /// In every part.
    void set(const std::string& name, const std::string& value) {
        for (std::size_t k = 0; k < parts.size(); ++k) {
            attribute(k, name).value = value;
            attribute(k, name).stated = std::uint32_t(value.size());
        }
    }
    void add(const std::string& name, const std::string& type, const std::string& value) {
        for (auto& part : parts) part.push_back({name, type, value, std::uint32_t(value.size())});
    }
    /// The head of chunk k, then its bytes.
    std::uint32_t chunk_size(std::size_t k) const { return exr::read_u32(chunks.data() + offsets[k] + 8); }
    std::string chunk(std::size_t k) const { return chunks.substr(offsets[k] + 12, chunk_size(k)); }
    /// Puts another in its place, at the end; what stood there stays, and nothing refers to it.
    void replace_chunk(std::size_t k, const std::string& data) {
        std::string head = chunks.substr(offsets[k], 8);
        const std::uint32_t size = std::uint32_t(data.size());
        head.append(reinterpret_cast<const char*>(&size), sizeof size);
        offsets[k] = chunks.size();
        chunks += head + data;
    }
};

/// The bytes of a value as they stand in a header.
template <class... T> std::string raw(T... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return bytes;
}

} // namespace glcast::samples
