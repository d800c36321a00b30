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
        if (accessor.sparse.isSparse) refuse("uses sparse accessors, which are not read");
        const auto& view = at(model.bufferViews, accessor.bufferView, "a buffer view");
        const auto& data = at(model.buffers, view.buffer, "a buffer").data;
        size = tinygltf::GetComponentSizeInBytes(accessor.componentType);
        count_per = tinygltf::GetNumComponentsInType(accessor.type);
        const int step = accessor.ByteStride(view);
        if (size < 1 || count_per < 1 || step < size * count_per) refuse("has an accessor of unknown type");
        stride = step;
        const std::size_t from = view.byteOffset + accessor.byteOffset;
        if (view.byteOffset > data.size() || accessor.byteOffset > data.size() || from > data.size() ||
            accessor.count == 0 || (data.size() - from) / stride + 1 < accessor.count ||
            from + (accessor.count - 1) * stride + std::size_t(size * count_per) > data.size())
            refuse("has an accessor beyond its buffer");
        first = data.data() + from;
    }
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
    template <class T> double scaled(const unsigned char* p, double one) const {
        T value;
        std::memcpy(&value, p, sizeof value);
        return accessor.normalized ? std::max(double(value) / one, -1.0) : double(value);
    }
    const tinygltf::Accessor& accessor;
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    int size = 0, count_per = 0;
};

} // namespace glcast::format
