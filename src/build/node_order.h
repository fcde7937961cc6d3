#pragma once
// The nodes of a complete tree, depth first: before a leaf come the nodes whose first leaf it is, the largest first.
// Leaf i is the first one of a node of 2^k leaves where 2^k divides i.

#include "src/build/lanes.h"

#include <bit>
#include <cstdint>

namespace manylights::detail {

// Of 2^kSmallHeight leaves. A tree's left half comes right behind its root, so the nodes of each smaller tree follow
// each other in here, too: those of 2^h leaves begin with number kSmallHeight - h.
constexpr std::uint32_t kSmallHeight = 8;
constexpr std::uint32_t kSmallNodes = (2u << kSmallHeight) - 1;

struct NodeOrder {
    std::uint32_t first_leaf[kSmallNodes + kLanePadding];
    std::uint32_t level[kSmallNodes + kLanePadding];
};

constexpr NodeOrder make_node_order() {
    NodeOrder order{};
    std::uint32_t at = 0;
    for (std::uint32_t leaf = 0; leaf < 1u << kSmallHeight; ++leaf) {
        std::uint32_t level = leaf == 0 ? kSmallHeight : static_cast<std::uint32_t>(std::countr_zero(leaf));
        for (++level; level-- > 0; ++at) {
            order.first_leaf[at] = leaf;
            order.level[at] = level;
        }
    }
    return order;
}

inline constexpr NodeOrder kNodeOrder = make_node_order();

} // namespace manylights::detail
