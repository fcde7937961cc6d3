// Replays the cells that plan decided: cells, nodes and references.
#include "src/build/lanes.h"
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/cells_write.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
constexpr hn::ScalableTag<std::uint32_t> kW;
constexpr auto kLanes = static_cast<std::uint32_t>(hn::MaxLanes(kW));

// Elements on their way to the caller's memory, where each is written once, in order: here whole vectors may be stored
// behind the last one.
template <typename T, std::uint32_t kRoom>
class Stream {
  public:
    explicit Stream(T* to) : to_(to) {}
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() { flush(); }

    // Room for count <= kRoom of them.
    HWY_INLINE T* room(std::uint32_t count) {
        if (count_ + count > kRoom) flush();
        return staged_ + count_;
    }
    HWY_INLINE void add(std::uint32_t count) { count_ += count; }
    // Where to write what needs more room, in ascending order; then passed by as many.
    T* direct() {
        flush();
        return to_;
    }
    void pass(std::uint32_t count) { to_ += count; }

  private:
    void flush() {
        if (count_ == 0) return; // and the caller may have no memory of this kind
        std::memcpy(static_cast<void*>(to_), staged_, count_ * sizeof(T));
        to_ += count_;
        count_ = 0;
    }

    T* to_;
    std::uint32_t count_ = 0;
    T staged_[kRoom + kSpanPadding];
};
using References = Stream<MlUint, 1024>;
using Nodes = Stream<MlNode, 1024>;
static_assert(kSmallTreeNodes <= 1024);

// Some of a cell's records: their lights to the references, their spans to a cell's.
void unpack(const CellRecord* records, std::uint32_t all, DepthSpan* spans, References& references) {
    constexpr std::uint32_t kTogether = 512;
    for (std::uint32_t begin = 0; begin < all; begin += kTogether) {
        const std::uint32_t count = HWY_MIN(all - begin, kTogether);
        MlUint* const to = references.room(count);
        for (std::uint32_t i = 0; i < count; i += kLanes) {
            Words light, span;
            hn::LoadInterleaved2(kW, reinterpret_cast<const std::uint32_t*>(records + begin + i), light, span);
            hn::StoreU(light, kW, to + i);
            hn::StoreU(span, kW, spans + begin + i);
        }
        references.add(count);
    }
}

// The spans of a cell's lights; its references are written by the way.
HWY_INLINE void unpack_cell(const Cells& cells, std::uint64_t cell, DepthSpan* spans, References& references) {
    for (std::size_t task = 0; task < cells.pools.size(); ++task) {
        visit_list(cells.pools[task], cell, [&](const CellRecord* records, std::uint32_t count) HWY_ATTR {
            unpack(records, count, spans, references);
            spans += count;
        });
    }
}

void write_nodes(const CellLights& lights, const GridCell& cell, std::uint32_t leaf_size, const TreeHeap& heap,
                 Nodes& nodes) {
    const std::uint32_t count = cell.node_count;
    const bool is_small = count <= kSmallTreeNodes;
    MlNode* const to = is_small ? nodes.room(count) : nodes.direct();
    if (cell.is_tree != 0)
        write_trees(lights, leaf_size, heap, to);
    else
        write_list(lights, to);
    if (is_small)
        nodes.add(count);
    else
        nodes.pass(count);
}

} // namespace

void write_cell_blocks(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                       const ManylightsBuffers& buffers) {
    Cells& cells = builder.cells;
    const bool lists = builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS;
    DepthSpan* const spans = cells.spans.data() + cell_room(cells) * task;
    float* const depths = cells.heaps.data() + 2 * heap_room(builder) * task;
    const TreeHeap heap = {depths, depths + heap_room(builder)};
    auto reference = static_cast<std::uint32_t>(cells.blocks[begin].first_reference);
    auto node = static_cast<std::uint32_t>(cells.blocks[begin].first_node);
    References references(static_cast<MlUint*>(buffers.references) + reference);
    Nodes nodes(static_cast<MlNode*>(buffers.nodes) + node);
    auto* const out = static_cast<MlCell*>(buffers.cells);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t last = std::min(end * kBlockCells, grid.cell_offset() + grid.cell_count());
        for (std::uint64_t c = std::max(begin * kBlockCells, grid.cell_offset()); c < last; ++c) {
            const GridCell cell = cells.cells[c];
            out[c] = lists ? MlCell{reference, cell.count} : MlCell{node, cell.node_count};
            if (cell.count == 0) continue;
            unpack_cell(cells, c, spans, references);
            if (!lists)
                write_nodes({spans, cell.count, reference, cells.codes[v]}, cell, builder.settings.leaf_size, heap,
                            nodes);
            reference += cell.count;
            node += cell.node_count;
        }
    }
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(write_cell_blocks);

void write_cell_blocks(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                       const ManylightsBuffers& buffers) {
    HWY_DYNAMIC_DISPATCH(write_cell_blocks)(builder, task, begin, end, buffers);
}

} // namespace manylights::detail
#endif
