// A tree of boxes over triangles that change. Internal. The order of the leaves is that of a Morton curve
// (Lauterbach et al. 2009, "Fast BVH construction on GPUs"); boxes follow what changes.
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace glcast {

/// In floats, rounded outwards by whoever makes it.
struct FloatBox {
    glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

    void add(const FloatBox& other) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
    }
    bool overlaps(const FloatBox& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
    bool operator==(const FloatBox&) const = default;
};

class BoxTree {
  public:
    struct Item {
        FloatBox box;
        glm::vec3 normal{0}; ///< of length 1, or 0
        std::uint32_t triangle = UINT32_MAX;
    };

    BoxTree() = default;
    /// Of any items; at most so many triangles have numbers.
    BoxTree(std::vector<Item>&& items, std::size_t triangles);

    /// Of its triangle, which must be one that the tree was made of; its box may be empty.
    void change(const Item& item);

    /// Calls visit(item) for every item whose box overlaps.
    template <typename F> void overlapping(const FloatBox& box, const F& visit) const {
        if (nodes.empty()) return;
        std::size_t stack[64], depth = 0;
        stack[depth++] = 1;
        while (depth) {
            const std::size_t node = stack[--depth];
            if (!nodes[node].overlaps(box)) continue;
            if (node < leaves()) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            const std::size_t first = (node - leaves()) * leaf_size,
                              last = std::min(first + leaf_size, items.size());
            for (std::size_t k = first; k < last; ++k)
                if (items[k].box.overlaps(box)) visit(items[k]);
        }
    }

  private:
    static constexpr std::size_t leaf_size = 4; // items
    std::size_t leaves() const { return nodes.size() / 2; }
    FloatBox of_leaf(std::size_t leaf) const;

    std::vector<Item> items;
    std::vector<std::uint32_t> place; ///< by triangle: its item
    std::vector<FloatBox> nodes; ///< [1] the root, [k] over [2 k] and [2 k + 1]; the last half the leaves
};

} // namespace glcast
