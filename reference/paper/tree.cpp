#include "reference/paper/tree.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::paper {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Cost of a visited node in tested lights, for Heuristic::expected_cost.
constexpr float kNodeCost = 0.5f;

std::uint32_t divide_up(std::uint32_t value, std::uint32_t by) { return value / by + (value % by != 0); }

std::uint32_t leaf_bits(std::uint32_t count) { return ML_NODE_LEAF | (count << ML_NODE_COUNT_SHIFT); }

// Children lie side by side; a count over 16 bits saturates, which nobody reads in an inner node.
MlNode parent_of(const MlNode& left, const MlNode& right) {
    const std::uint32_t count = ml_node_light_count(left.bits) + ml_node_light_count(right.bits);
    return {std::min(left.min_depth, right.min_depth), std::max(left.max_depth, right.max_depth), left.first,
            std::min(count, ML_NODE_COUNT_MAX) << ML_NODE_COUNT_SHIFT};
}

MlNode leaf_over(const CellLights& lights, std::uint32_t begin, std::uint32_t end) {
    MlNode leaf{kInfinity, -kInfinity, lights.first + begin, leaf_bits(end - begin)};
    for (std::uint32_t i = begin; i < end; ++i) {
        leaf.min_depth = std::min(leaf.min_depth, lights.ranges[i].min);
        leaf.max_depth = std::max(leaf.max_depth, lights.ranges[i].max);
    }
    return leaf;
}

// The part of a slice that the range covers: the chance that a depth hits it, if depths are uniform in the slice.
float hit_chance(DepthRange range, SliceExtent extent) {
    const float overlap = std::min(range.max, extent.max) - std::max(range.min, extent.min);
    return std::max(overlap, 0.0f) / (extent.max - extent.min);
}

DepthRange join(DepthRange a, DepthRange b) { return {std::min(a.min, b.min), std::max(a.max, b.max)}; }

constexpr DepthRange kNothing{kInfinity, -kInfinity};

// A split leaves at least an eighth of the lights on each side, so that a tree is at most log n / log (8 / 7) deep, and
// its build O(n log n).
constexpr std::uint32_t kLeastShare = 8;

// So many lights at most make one top-down tree: it has no more leaves than lights, and each leaf more than an eighth
// of leaf_size.
std::uint64_t most_lights_top_down(std::uint32_t leaf_size) {
    return std::uint64_t{kMaxTreeLeaves} * std::max(leaf_size / kLeastShare, 1u);
}

bool meets(const MlNode& node, SliceExtent extent) {
    return node.min_depth < extent.max && node.max_depth >= extent.min;
}

} // namespace

// In a perfect tree whose breadth-first array holds the leaves first and the root last, the left child of node i is
// (2 i) AND node_count, with node_count = 2^levels - 1 (slides). A subtree of k levels has 2^k - 1 nodes: to skip it is
// to skip those.
std::vector<DepthFirstEntry> depth_first_table(std::uint32_t levels) {
    const std::uint32_t node_count = (1u << levels) - 1;
    std::vector<DepthFirstEntry> table(node_count);
    table[0] = {std::uint16_t(node_count - 1), std::uint16_t(node_count)};
    for (std::uint32_t i = 0; i < node_count; ++i) {
        if (table[i].skip == 1) continue;
        const std::uint32_t left = (2u * table[i].breadth_first) & node_count;
        const auto child_skip = std::uint16_t(table[i].skip / 2);
        table[i + 1] = {std::uint16_t(left), child_skip};
        table[i + 1 + child_skip] = {std::uint16_t(left + 1), child_skip};
    }
    return table;
}

bool prefers_tree(Heuristic heuristic, const CellLights& lights, SliceExtent extent) {
    if (heuristic == Heuristic::always_tree) return true;
    if (heuristic == Heuristic::always_list || heuristic == Heuristic::expected_cost) return false;
    const bool clips = heuristic != Heuristic::diameter_extent;
    const float lower = clips ? extent.min : -kInfinity, upper = clips ? extent.max : kInfinity;
    const auto overlap = [&](std::uint32_t i) {
        return std::min(lights.ranges[i].max, upper) - std::max(lights.ranges[i].min, lower);
    };
    float sums[4] = {}; // four chains of additions instead of one
    std::uint32_t i = 0;
    for (; i + 4 <= lights.count; i += 4)
        for (std::uint32_t k = 0; k < 4; ++k) sums[k] += overlap(i + k);
    for (; i < lights.count; ++i) sums[0] += overlap(i);
    const float sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    const float limit = heuristic == Heuristic::clipped_half_extent ? 0.5f : 1.0f;
    return sum / float(lights.count) < limit * (extent.max - extent.min);
}

// Several trees in a row are walked as they are. No leaf outside of the subtree can be hit: on the way down, the
// sibling that is left behind misses the slice.
MlCell entry_in_slice(const MlNode* nodes, const MlCell& tile, SliceExtent extent) {
    MlCell entry = tile;
    if (tile.count == 0 || ml_node_skip_count(nodes[tile.first].bits) != tile.count) return entry;
    while (!ml_node_is_leaf(nodes[entry.first].bits)) {
        const std::uint32_t left = entry.first + 1, left_count = ml_node_skip_count(nodes[left].bits);
        const std::uint32_t right = left + left_count;
        const bool meets_left = meets(nodes[left], extent), meets_right = meets(nodes[right], extent);
        if (meets_left && meets_right) return entry;
        if (!meets_left && !meets_right) return {entry.first, 0};
        entry = meets_left ? MlCell{left, left_count} : MlCell{right, ml_node_skip_count(nodes[right].bits)};
    }
    return meets(nodes[entry.first], extent) ? entry : MlCell{entry.first, 0};
}

TreeBuilder::TreeBuilder() {
    for (std::uint32_t levels = 1; levels <= kMaxTreeLevels; ++levels) tables_[levels] = depth_first_table(levels);
}

std::uint32_t TreeBuilder::build_cell(const CellLights& lights, SliceExtent extent, const Options& options) {
    const std::uint32_t first_node = node_count_;
    const std::size_t first_tree = trees_.size();
    const bool one_leaf = lights.count <= options.leaf_size;
    if (options.structure == Structure::tree) {
        built_tree_ = !one_leaf;
        add_trees(lights, extent, options);
        return node_count_ - first_node;
    }
    built_tree_ = !one_leaf && prefers_tree(options.heuristic, lights, extent);
    if (!one_leaf && options.heuristic == Heuristic::expected_cost) {
        add_trees(lights, extent, options);
        built_tree_ = expected_cost(first_tree, extent) < kNodeCost + float(lights.count);
        if (!built_tree_) {
            node_count_ = first_node;
            trees_.resize(first_tree);
            add_list(lights, options);
        }
    } else if (built_tree_) {
        add_trees(lights, extent, options);
    } else {
        add_list(lights, options);
    }
    return node_count_ - first_node;
}

// A leaf counts 16 bits of lights: a longer list is several leaves in a row.
void TreeBuilder::add_list(const CellLights& lights, const Options& options) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t end = begin + std::min(lights.count - begin, ML_NODE_COUNT_MAX);
        MlNode leaf{-kInfinity, kInfinity, lights.first + begin, leaf_bits(end - begin)};
        if (options.list_bounds == ListBounds::of_lights) leaf = leaf_over(lights, begin, end);
        scratch_.require(node_count_ + 1, node_count_)[node_count_] = leaf;
        trees_.push_back({node_count_++, 1, 1});
        begin = end;
    }
}

// More lights than fit the leaves of one tree: several trees in a row.
void TreeBuilder::add_trees(const CellLights& lights, SliceExtent extent, const Options& options) {
    const bool top_down = options.tree_build == TreeBuild::top_down;
    const std::uint64_t most =
        top_down ? most_lights_top_down(options.leaf_size) : std::uint64_t(kMaxTreeLeaves) * options.leaf_size;
    for (std::uint64_t begin = 0; begin < lights.count; begin += most) {
        const auto count = std::uint32_t(std::min<std::uint64_t>(lights.count - begin, most));
        const CellLights part{lights.first + std::uint32_t(begin), count, lights.ranges + begin};
        top_down ? add_tree_top_down(part, extent, options.leaf_size) : add_tree_bottom_up(part, options.leaf_size);
    }
}

void TreeBuilder::add_tree_top_down(const CellLights& lights, SliceExtent extent, std::uint32_t leaf_size) {
    const std::uint32_t first_node = node_count_;
    add_subtree(lights, extent, leaf_size);
    trees_.push_back({first_node, node_count_ - first_node, 0});
}

void TreeBuilder::add_subtree(const CellLights& lights, SliceExtent extent, std::uint32_t leaf_size) {
    const std::uint32_t place = node_count_++;
    scratch_.require(node_count_, place);
    if (lights.count <= leaf_size) {
        scratch_.data()[place] = leaf_over(lights, 0, lights.count);
        scratch_.data()[place].bits |= 1;
        return;
    }
    const std::uint32_t split = best_split(lights, extent);
    add_subtree({lights.first, split, lights.ranges}, extent, leaf_size);
    const std::uint32_t right = node_count_;
    add_subtree({lights.first + split, lights.count - split, lights.ranges + split}, extent, leaf_size);
    MlNode* nodes = scratch_.data();
    nodes[place] = parent_of(nodes[place + 1], nodes[right]);
    nodes[place].bits |= node_count_ - place;
}

// How many lights go to the left: so that the tests are fewest which a depth can expect if both sides were leaves. The
// middle, where no other is better.
std::uint32_t TreeBuilder::best_split(const CellLights& lights, SliceExtent extent) {
    const std::uint32_t least = std::max(lights.count / kLeastShare, 1u);
    float* costs = costs_.require(lights.count);
    DepthRange range = kNothing;
    for (std::uint32_t i = 0; i < lights.count; ++i) {
        costs[i] = hit_chance(range, extent) * float(i);
        range = join(range, lights.ranges[i]);
    }
    range = kNothing;
    for (std::uint32_t i = lights.count; i-- > least;) {
        range = join(range, lights.ranges[i]);
        costs[i] += hit_chance(range, extent) * float(lights.count - i);
    }
    std::uint32_t best = lights.count / 2;
    for (std::uint32_t i = least; i <= lights.count - least; ++i)
        if (costs[i] < costs[best]) best = i;
    return best;
}

// Lights are dealt to the leaves in order, as evenly as whole numbers allow; what is left over of the power of two is
// padding that no depth hits.
void TreeBuilder::add_tree_bottom_up(const CellLights& lights, std::uint32_t leaf_size) {
    const std::uint32_t leaves = std::bit_ceil(divide_up(lights.count, leaf_size));
    const std::uint32_t per_leaf = divide_up(lights.count, leaves);
    const std::uint32_t node_count = 2 * leaves - 1;
    MlNode* nodes = scratch_.require(node_count_ + node_count, node_count_) + node_count_;
    std::uint32_t begin = 0;
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
        const std::uint32_t end = std::min(begin + per_leaf, lights.count);
        nodes[leaf] = leaf_over(lights, begin, end);
        begin = end;
    }
    for (std::uint32_t node = leaves, child = 0; node < node_count; ++node, child += 2)
        nodes[node] = parent_of(nodes[child], nodes[child + 1]);
    trees_.push_back({node_count_, node_count, std::uint32_t(std::bit_width(leaves))});
    node_count_ += node_count;
}

// Every root is visited, every other node where its parent is hit, and a leaf's lights are tested where the leaf is
// hit.
float TreeBuilder::expected_cost(std::size_t first_tree, SliceExtent extent) const {
    float cost = 0.0f;
    for (std::size_t tree = first_tree; tree < trees_.size(); ++tree) {
        const MlNode* nodes = scratch_.data() + trees_[tree].first_node;
        cost += kNodeCost;
        for (std::uint32_t i = 0; i < trees_[tree].node_count; ++i) {
            const bool leaf = ml_node_is_leaf(nodes[i].bits);
            const float price = leaf ? float(ml_node_light_count(nodes[i].bits)) : 2.0f * kNodeCost;
            cost += hit_chance({nodes[i].min_depth, nodes[i].max_depth}, extent) * price;
        }
    }
    return cost;
}

void TreeBuilder::pack(MlNode* nodes) {
    for (const Tree& tree : trees_) {
        const MlNode* from = scratch_.data() + tree.first_node;
        MlNode* to = nodes + tree.first_node;
        if (tree.levels == 0) {
            std::copy_n(from, tree.node_count, to);
            continue;
        }
        const DepthFirstEntry* table = tables_[tree.levels].data();
        for (std::uint32_t i = 0; i < tree.node_count; ++i) {
            to[i] = from[table[i].breadth_first];
            to[i].bits |= table[i].skip;
        }
    }
    clear();
}

void TreeBuilder::clear() {
    trees_.clear();
    node_count_ = 0;
}

} // namespace manylights::paper
