// Elements of glTF accessors, every one inside its buffer. Internal.
#pragma once
#include <algorithm>
#include <cstring>
#include <glm/vec3.hpp>
#include <string>
#include <tiny_gltf.h>
#include <vector>

#include "tools/io/mesh_format.h"

namespace glcast::format {

template <class T> const T& at(const std::vector<T>& items, int index, const char* what) {
    if (index < 0 || std::size_t(index) >= items.size())
        refuse(std::string("refers to ") + what + " that is not there");
    return items[index];
}

/// An accessor's elements as doubles, every one inside the buffer.
class Elements {
  public:
    Elements(const tinygltf::Model& model, int index) : accessor(at(model.accessors, index, "an accessor")) {
        size = tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType));
        count_per = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
        if (size < 1 || count_per < 1 || accessor.count == 0) refuse("has an accessor of unknown type");
        if (accessor.bufferView >= 0) {
            const auto& view = at(model.bufferViews, accessor.bufferView, "a buffer view");
            const int step = accessor.ByteStride(view);
            if (step < size * count_per) refuse("has an accessor of unknown type");
            stride = std::size_t(step);
            first = span(model, accessor.bufferView, accessor.byteOffset, accessor.count, stride, element_bytes());
        }
        if (accessor.sparse.isSparse || accessor.bufferView < 0) fill(model);
    }
    Elements(const Elements&) = delete;
    Elements& operator=(const Elements&) = delete;
    std::size_t count() const { return accessor.count; }
    int components() const { return count_per; }

    double get(std::size_t element, int component) const {
        const unsigned char* p = first + element * stride + std::size_t(component * size);
        switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled<std::int8_t>(p, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled<std::uint8_t>(p, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled<std::int16_t>(p, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled<std::uint16_t>(p, 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return scaled<std::uint32_t>(p, 4294967295.0);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return scaled<float>(p, 1);
        default:
            return 0;
        }
    }
    glm::dvec3 vec3(std::size_t element) const {
        if (count_per < 3) refuse("has an attribute of fewer than three components");
        return {get(element, 0), get(element, 1), get(element, 2)};
    }

  private:
    std::size_t element_bytes() const { return std::size_t(size) * std::size_t(count_per); }

    /// Where `count` elements begin that lie in a view's buffer.
    static const unsigned char* span(const tinygltf::Model& model, int index, std::size_t offset, std::size_t count,
                                     std::size_t stride, std::size_t bytes) {
        const auto& view = at(model.bufferViews, index, "a buffer view");
        const auto& data = at(model.buffers, view.buffer, "a buffer").data;
        const std::size_t from = view.byteOffset + offset;
        if (view.byteOffset > data.size() || offset > data.size() || from > data.size() || count == 0 ||
            (data.size() - from) / stride + 1 < count || from + (count - 1) * stride + bytes > data.size())
            refuse("has an accessor beyond its buffer");
        return data.data() + from;
    }

    /// Sparse accessors are zeros, or what their view has, but for some elements.
    void fill(const tinygltf::Model& model) {
        std::size_t most = 100'000;
        for (const tinygltf::Buffer& buffer : model.buffers) most += 8 * buffer.data.size();
        const std::size_t bytes = element_bytes();
        if (accessor.count > most / bytes) refuse("has an accessor of more elements than its bytes explain");
        own.assign(accessor.count * bytes, 0);
        for (std::size_t k = 0; first && k < accessor.count; ++k)
            std::memcpy(&own[k * bytes], first + k * stride, bytes);
        first = own.data(), stride = bytes;
        if (!accessor.sparse.isSparse) return;
        const auto& sparse = accessor.sparse;
        const int index_size = tinygltf::GetComponentSizeInBytes(std::uint32_t(sparse.indices.componentType));
        if (index_size < 1 || index_size > 4 || sparse.count < 1 || sparse.indices.byteOffset < 0 ||
            sparse.values.byteOffset < 0)
            refuse("has a sparse accessor of unknown type");
        const std::size_t count = std::size_t(sparse.count), step = std::size_t(index_size);
        const auto* where = span(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count, step, step);
        const auto* what = span(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count, bytes, bytes);
        for (std::size_t k = 0; k < count; ++k) {
            std::uint32_t element = 0;
            std::memcpy(&element, where + k * step, step);
            if (element >= accessor.count) refuse("has a sparse accessor beyond its elements");
            std::memcpy(&own[element * bytes], what + k * bytes, bytes);
        }
    }

    template <class T> double scaled(const unsigned char* p, double one) const {
        T value;
        std::memcpy(&value, p, sizeof value);
        return accessor.normalized ? std::max(double(value) / one, -1.0) : double(value);
    }
    const tinygltf::Accessor& accessor;
    std::vector<unsigned char> own; ///< of a sparse accessor
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    int size = 0, count_per = 0;
};

} // namespace glcast::format
