#pragma once
// What the buffers hold, and how many bytes of each: the C++ side of <manylights/format.h>.

#include "manylights/manylights.h"

#include <manylights/format.h>

#include <cstdint>
#include <type_traits>

namespace manylights::detail {

static_assert(sizeof(MlView) == 64 && sizeof(MlCell) == 8 && sizeof(MlNode) == 16);
static_assert(std::is_trivially_copyable_v<MlView> && std::is_trivially_copyable_v<MlNode>);
static_assert(MANYLIGHTS_STRUCTURE_LISTS == ML_STRUCTURE_LISTS && MANYLIGHTS_STRUCTURE_TREES == ML_STRUCTURE_TREES &&
              MANYLIGHTS_STRUCTURE_HYBRID == ML_STRUCTURE_HYBRID);
static_assert(sizeof(MlTile) == 2 * sizeof(MlCell));

constexpr std::uint32_t kMaxViews = 8;
constexpr std::uint32_t kMaxSlices = 128;
constexpr std::uint32_t kMaxPixels = 65536;                 // per side of an image
constexpr std::uint32_t kMaxLeafLights = ML_NODE_COUNT_MAX; // a node's 16-bit light count
// A root over m leaves skips its 2m - 1 nodes; 16,384 leaves are the most whose count fits 15 bits.
constexpr std::uint32_t kMaxLeaves = (ML_NODE_SKIP_MAX + 1) / 2;
constexpr std::uint32_t kMaxTreeLights = kMaxLeaves * kMaxLeafLights;
static_assert(2 * kMaxLeaves - 1 == ML_NODE_SKIP_MAX);

inline std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) { return a / b + (a % b != 0 ? 1 : 0); }

// A complete binary tree over some lights: dealt to the leaves in order, lights_per_leaf each, the last ones fewer or
// none (padding).
struct TreeShape {
    std::uint32_t leaf_count; // a power of two, at most kMaxLeaves
    std::uint32_t lights_per_leaf;

    std::uint32_t node_count() const { return 2 * leaf_count - 1; }
};

// light_count in [1, kMaxTreeLights]. Where leaf_size would take more than kMaxLeaves leaves, leaves grow.
TreeShape tree_shape(std::uint32_t light_count, std::uint32_t leaf_size);

// Nodes of a cell that holds trees: one, or several in a row where the lights exceed kMaxTreeLights. May exceed 32
// bits' worth only for counts that do.
std::uint64_t tree_node_count(std::uint32_t light_count, std::uint32_t leaf_size);

// Nodes of a cell that holds a list: one leaf, or a run of them where the lights exceed kMaxLeafLights.
inline std::uint32_t list_node_count(std::uint32_t light_count) { return divide_up(light_count, kMaxLeafLights); }

inline MlUint pack_leaf(std::uint32_t light_count) { return ML_NODE_LEAF | (light_count << ML_NODE_COUNT_SHIFT) | 1u; }
// The count saturates.
inline MlUint pack_inner(std::uint32_t light_count, std::uint32_t skip) {
    return ((light_count < ML_NODE_COUNT_MAX ? light_count : ML_NODE_COUNT_MAX) << ML_NODE_COUNT_SHIFT) | skip;
}

// Words per reference: windows have bounds beside the light index.
inline std::uint32_t reference_words(std::uint32_t structure) { return structure == ML_STRUCTURE_WINDOWS ? 2 : 1; }

// Elements per buffer.
struct Counts {
    std::uint64_t views, slice_edges, cells, nodes, references;
    std::uint32_t reference_words = 1; // of each reference
};

ManylightsSizes sizes_of(const Counts& counts);
std::uint64_t total_bytes(const ManylightsSizes& sizes);

} // namespace manylights::detail
