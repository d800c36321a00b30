#include "tools/simplify/box_tree.h"

#include <bit>
#include <utility>

#include "tools/mesh/morton.h"

namespace glcast {
namespace {

std::vector<BoxTree::Item> along_curve(const std::vector<BoxTree::Item>& items) {
    FloatBox all;
    for (const BoxTree::Item& item : items) all.add(item.box);
    std::vector<std::uint64_t> keys(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        std::uint32_t key = 0;
        for (int k = 0; k < 3; ++k) {
            const float size = all.high[k] - all.low[k],
                        at = (items[i].box.low[k] + items[i].box.high[k]) / 2 - all.low[k];
            key |= spread_bits(size > 0 ? std::uint32_t(std::clamp(at / size, 0.0f, 1.0f) * 1023) : 0) << k;
        }
        keys[i] = std::uint64_t(key) << 32 | i;
    }
    std::sort(keys.begin(), keys.end());
    std::vector<BoxTree::Item> sorted;
    sorted.reserve(items.size());
    for (const std::uint64_t key : keys) sorted.push_back(items[key & UINT32_MAX]);
    return sorted;
}

} // namespace

BoxTree::BoxTree(std::vector<Item>&& from, std::size_t triangles)
    : items(along_curve(from)), place(triangles, UINT32_MAX) {
    if (items.empty()) return;
    for (std::uint32_t i = 0; i < items.size(); ++i) place[items[i].triangle] = i;
    const std::size_t count = std::bit_ceil((items.size() + leaf_size - 1) / leaf_size);
    nodes.resize(2 * count);
    for (std::size_t leaf = 0; leaf < count; ++leaf) nodes[count + leaf] = of_leaf(leaf);
    for (std::size_t node = count - 1; node > 0; --node) {
        nodes[node] = nodes[2 * node];
        nodes[node].add(nodes[2 * node + 1]);
    }
}

FloatBox BoxTree::of_leaf(std::size_t leaf) const {
    FloatBox box;
    const std::size_t last = std::min((leaf + 1) * leaf_size, items.size());
    for (std::size_t k = leaf * leaf_size; k < last; ++k) box.add(items[k].box);
    return box;
}

void BoxTree::change(const Item& item) {
    const std::uint32_t i = place[item.triangle];
    items[i] = item;
    const std::size_t leaf = i / leaf_size;
    FloatBox box = of_leaf(leaf);
    for (std::size_t node = leaves() + leaf; nodes[node] != box; node /= 2) {
        nodes[node] = box;
        if (node == 1) return;
        box.add(nodes[node ^ 1]);
    }
}

} // namespace glcast
