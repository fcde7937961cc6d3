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

// Those of the same instruction set (tree.cpp): none is chosen for each cell anew.
MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, NodeDepths* heap, MlNode* nodes);
MlNode* write_list(const CellLights& lights, MlNode* nodes);

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

// Some of a cell's records: their lights to the references, their spans to a cell's. Returns the spans' end.
HWY_INLINE DepthSpan* unpack(const CellRecord* records, std::uint32_t all, DepthSpan* spans, References& references) {
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
    return spans + all;
}

HWY_NOINLINE DepthSpan* unpack_chunks(const CellPool& pool, std::uint64_t cell, DepthSpan* spans,
                                      References& references) {
    visit_chunks(pool, cell, [&](const CellRecord* records, std::uint32_t count) HWY_ATTR {
        spans = unpack(records, count, spans, references);
    });
    return spans;
}

// The spans of a cell's lights; its references are written by the way.
HWY_INLINE void unpack_cell(const Cells& cells, std::uint64_t cell, DepthSpan* spans, References& references) {
    for (std::size_t task = 0; task < cells.pools.size(); ++task) {
        const CellPool& pool = cells.pools[task];
        const HomeItems<CellRecord> home = items_at_home(pool, cell);
        spans = unpack(home.items, home.count, spans, references);
        if (HWY_UNLIKELY(!home.is_all)) spans = unpack_chunks(pool, cell, spans, references);
    }
}

void write_nodes(const CellLights& lights, const GridCell& cell, std::uint32_t leaf_size, NodeDepths* heap,
                 Nodes& nodes) {
    const std::uint32_t count = cell.node_count;
    const bool is_small = count <= kSmallTreeNodes;
    MlNode* const to = is_small ? nodes.room(count) : nodes.direct();
    if (cell.is_tree != 0)
        HWY_NAMESPACE::write_trees(lights, leaf_size, heap, to);
    else
        HWY_NAMESPACE::write_list(lights, to);
    if (is_small)
        nodes.add(count);
    else
        nodes.pass(count);
}

// A task's way through its cells.
class Writer {
  public:
    Writer(ManylightsBuilder& builder, std::uint32_t task, const CellBlock& first, const ManylightsBuffers& buffers)
        : builder_(builder), lists_(builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS),
          spans_(builder.cells.spans.data() + cell_room(builder.cells) * task),
          heap_(builder.cells.heaps.data() + heap_room(builder) * task), cells_(static_cast<MlCell*>(buffers.cells)),
          reference_(static_cast<std::uint32_t>(first.first_reference)),
          node_(static_cast<std::uint32_t>(first.first_node)),
          references_(static_cast<MlUint*>(buffers.references) + reference_),
          nodes_(static_cast<MlNode*>(buffers.nodes) + node_) {}

    // Cells without lights.
    void skip(std::uint64_t begin, std::uint64_t end) {
        const MlCell empty = {lists_ ? reference_ : node_, 0};
        std::fill(cells_ + begin, cells_ + end, empty);
    }

    void write(std::uint64_t c, const DepthCodes& codes) {
        const GridCell cell = builder_.cells.cells[c];
        cells_[c] = lists_ ? MlCell{reference_, cell.count} : MlCell{node_, cell.node_count};
        if (cell.count == 0) return;
        unpack_cell(builder_.cells, c, spans_, references_);
        if (!lists_)
            write_nodes({spans_, cell.count, reference_, codes}, cell, builder_.settings.leaf_size, heap_, nodes_);
        reference_ += cell.count;
        node_ += cell.node_count;
    }

  private:
    const ManylightsBuilder& builder_;
    const bool lists_;
    DepthSpan* const spans_;
    NodeDepths* const heap_;
    MlCell* const cells_;
    std::uint32_t reference_, node_;
    References references_;
    Nodes nodes_;
};

} // namespace

void write_cell_blocks(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                       const ManylightsBuffers& buffers) {
    const Cells& cells = builder.cells;
    Writer writer(builder, task, cells.blocks[begin], buffers);
    const auto view_end = [&](std::uint32_t v) {
        return builder.grids[v].cell_offset() + builder.grids[v].cell_count();
    };
    std::uint32_t view = 0;
    std::uint64_t end_of_view = view_end(view);
    for (std::uint64_t b = begin; b < end; ++b) {
        const std::uint64_t first = b * kBlockCells;
        const std::uint64_t last = std::min<std::uint64_t>(first + kBlockCells, cells.cells.size());
        if (cells.blocks[b + 1].first_reference == cells.blocks[b].first_reference) {
            writer.skip(first, last);
            continue;
        }
        for (std::uint64_t c = first; c < last; ++c) {
            while (c >= end_of_view) end_of_view = view_end(++view);
            writer.write(c, cells.codes[view]);
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
