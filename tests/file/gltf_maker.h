// glTF files as other programs write them: built by tests from JSON and bytes.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/io/glb_container.h"

namespace glcast::samples {

/// A description with one buffer, and accessors that fill it.
struct GltfMaker {
    nlohmann::ordered_json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    /// Values one after the other; the accessor's number.
    template <class T> int add(const std::vector<T>& values, int component, const char* type, int per) {
        using Json = nlohmann::ordered_json;
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}});
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        json["accessors"].push_back(Json{{"bufferView", json["bufferViews"].size() - 1},
                                         {"componentType", component},
                                         {"count", values.size() / std::size_t(per)},
                                         {"type", type}});
        return int(json["accessors"].size()) - 1;
    }
    int floats(const std::vector<float>& values, const char* type = "VEC3", int per = 3) {
        return add(values, 5126, type, per);
    }
    int indices(const std::vector<std::uint16_t>& values) { return add(values, 5123, "SCALAR", 1); }

    /// A node of a mesh with these primitives.
    void mesh(nlohmann::ordered_json primitives) {
        json["nodes"].push_back({{"mesh", json.contains("meshes") ? json["meshes"].size() : 0}});
        json["meshes"].push_back({{"primitives", std::move(primitives)}});
    }

    std::string glb() const {
        nlohmann::ordered_json all = json;
        if (!all.contains("buffers")) all["buffers"] = {{{"byteLength", bytes.size()}}};
        return format::glb_file(all, bytes);
    }
    /// The description alone: buffers are named in it.
    std::string gltf() const { return json.dump(); }
};

/// A box of 1 x 2 x 3 at the origin: its corners and, outwards, its triangles.
inline const std::vector<float> box_corners{0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0,
                                            0, 0, 3, 1, 0, 3, 1, 2, 3, 0, 2, 3};
inline const std::vector<std::uint16_t> box_indices{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                    1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/// One node with that box.
inline GltfMaker box_gltf() {
    GltfMaker maker;
    const int corners = maker.floats(box_corners), triangles = maker.indices(box_indices);
    maker.mesh({{{"attributes", {{"POSITION", corners}}}, {"indices", triangles}}});
    return maker;
}

} // namespace glcast::samples
