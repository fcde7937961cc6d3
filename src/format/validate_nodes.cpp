#include "src/format/validate.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::detail {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Walks the nodes of a cell depth first, in the order that they are stored.
class NodeWalk {
  public:
    NodeWalk(const Contents& contents, std::uint64_t first_node, std::uint64_t first_reference)
        : contents_(contents), node_(first_node), reference_(first_reference) {}

    std::uint64_t node() const { return node_; }
    std::uint64_t reference() const { return reference_; }

    // The node here and all below it, leaf_count leaves. Recurses no deeper than a 15-bit skip count can be halved.
    Outcome subtree(std::uint32_t leaf_count, float low, float high, std::uint64_t& light_count) {
        const std::uint64_t index = node_++;
        const MlNode node = contents_.nodes[index];
        const std::uint32_t skip = 2 * leaf_count - 1;
        if (ml_node_skip_count(node.bits) != skip || ml_node_is_leaf(node.bits) != (leaf_count == 1))
            return damaged("nodes", "must form complete binary trees, depth first", index);
        if (!(node.min_depth >= low && node.max_depth <= high))
            return damaged("nodes", "depths must lie within the parent's", index);
        if (node.first != reference_)
            return damaged("nodes", "first must be the end of the references before it", index);
        if (leaf_count == 1) return leaf(node, index, light_count);

        std::uint64_t left = 0;
        std::uint64_t right = 0;
        const std::uint32_t half = leaf_count / 2;
        if (Outcome outcome = subtree(half, node.min_depth, node.max_depth, left); !outcome.ok()) return outcome;
        if (Outcome outcome = subtree(half, node.min_depth, node.max_depth, right); !outcome.ok()) return outcome;
        light_count = left + right;
        if (ml_node_light_count(node.bits) != std::min<std::uint64_t>(light_count, ML_NODE_COUNT_MAX))
            return damaged("nodes", "an inner node must count the lights below it, at most 65535", index);
        return {};
    }

  private:
    Outcome leaf(const MlNode& node, std::uint64_t index, std::uint64_t& light_count) {
        light_count = ml_node_light_count(node.bits);
        if (light_count == 0 && !(node.min_depth == kInfinity && node.max_depth == -kInfinity))
            return damaged("nodes", "a leaf without lights must have the depths +inf and -inf", index);
        if (light_count != 0 && !(node.min_depth <= node.max_depth))
            return damaged("nodes", "min_depth must not exceed max_depth", index);
        reference_ += light_count;
        if (reference_ > contents_.counts.references) return damaged("nodes", "must lie within the references", index);
        return {};
    }

    const Contents& contents_;
    std::uint64_t node_;
    std::uint64_t reference_;
};

} // namespace

Outcome validate_nodes(const Contents& contents, MlCell cell, ReferenceRange& references) {
    references = {0, 0};
    if (cell.count == 0) return {};
    const std::uint64_t end = static_cast<std::uint64_t>(cell.first) + cell.count;
    references.begin = contents.nodes[cell.first].first;
    NodeWalk walk(contents, cell.first, references.begin);
    while (walk.node() < end) {
        const std::uint32_t skip = ml_node_skip_count(contents.nodes[walk.node()].bits);
        if (!std::has_single_bit(skip + 1) || skip == 0 || walk.node() + skip > end)
            return damaged("nodes", "a root must skip 2 m - 1 nodes within its cell, m a power of two", walk.node());
        std::uint64_t light_count = 0;
        if (Outcome outcome = walk.subtree((skip + 1) / 2, -kInfinity, kInfinity, light_count); !outcome.ok())
            return outcome;
    }
    references.end = walk.reference();
    return {};
}

} // namespace manylights::detail
