#include "reference/paper/pipeline.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace manylights::paper {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

void check(const Options& options, std::span<const ManylightsView> views) {
    if (options.tile_px < 8 || options.tile_px > 65536) throw std::invalid_argument("tile_px must be in [8, 65536]");
    if (options.leaf_size < 1 || options.leaf_size > ML_NODE_COUNT_MAX)
        throw std::invalid_argument("leaf_size must be in [1, 65535]");
    for (const ManylightsView& view : views)
        if (view.width < 1 || view.width > 65536 || view.height < 1 || view.height > 65536)
            throw std::invalid_argument("view.width and view.height must be in [1, 65536]");
}

void check_reference_count(std::uint64_t count) {
    if (count > kMost) throw std::length_error("more than 2^32 - 1 references");
}

void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

bool has_entries(const Options& options) {
    return options.structure == Structure::tree && options.tree_entry == TreeEntry::per_slice;
}

// A cell with a range of nodes per slice is what a hybrid has.
MlUint structure_code(const Options& options) {
    if (options.structure == Structure::clustered) return ML_STRUCTURE_LISTS;
    return options.structure == Structure::tree && !has_entries(options) ? ML_STRUCTURE_TREES : ML_STRUCTURE_HYBRID;
}

bool sorts_all(const Options& options) {
    return options.structure != Structure::clustered && options.sort_scope == SortScope::all_lights;
}

// Of a light that reaches to both infinities the middle is no number, and any key will do.
std::uint32_t cell_sort_key(const CellLight& light, SortKey key) {
    const float depth = key == SortKey::near_depth ? light.min_depth : light.min_depth + light.max_depth;
    return sort_key(depth == depth ? depth : 0.0f);
}

// Fewer pairs than that are sorted sooner by comparison than by digits.
constexpr std::uint32_t kFewPairs = 512;

} // namespace

// Adds the time since the last call to a stage, or does nothing.
class PaperPipeline::StageClock {
  public:
    explicit StageClock(bool runs) : runs_(runs) {
        if (runs_) last_ = std::chrono::steady_clock::now();
    }
    void lap(double& milliseconds) {
        if (!runs_) return;
        const auto now = std::chrono::steady_clock::now();
        milliseconds += std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
    }

  private:
    bool runs_;
    std::chrono::steady_clock::time_point last_;
};

const Buffers& PaperPipeline::build(std::span<const ManylightsView> views, const ManylightsLights& lights,
                                    const Options& options) {
    check(options, views);
    slices_.update(options, options.structure == Structure::tree ? 1 : options.slice_count);
    entry_slices_.update(options, has_entries(options) ? options.slice_count : 1);
    views_.clear();
    tree_builder_.clear();
    cell_count_ = node_count_ = reference_count_ = 0;
    buffers_ = {};
    StageClock clock(options.time_stages);
    for (const ManylightsView& view : views) build_view(view, lights, options, clock);
    buffers_.views = views_;
    buffers_.slice_edges = has_entries(options) ? entry_slices_.edges() : slices_.edges();
    buffers_.cells = {cells_.data(), cell_count_};
    buffers_.nodes = {nodes_.data(), node_count_};
    buffers_.references = {references_.data(), reference_count_};
    return buffers_;
}

void PaperPipeline::build_view(const ManylightsView& view, const ManylightsLights& lights, const Options& options,
                               StageClock& clock) {
    const Camera camera = read_camera(view);
    const Grid grid = make_grid(camera, options.tile_px);
    place_view(camera, grid, options);
    const std::uint32_t cell_count = grid.tiles_x * grid.tiles_y * slices_.count();
    const bool has_trees = options.structure != Structure::clustered;

    const CullCounts counts = cull(camera, grid.widening_px, lights, culled_);
    buffers_.visible_lights += counts.kept;
    buffers_.ignored_lights = counts.ignored;
    clock.lap(buffers_.times.cull);

    if (sorts_all(options)) sort_lights(counts.kept, options); // lists need no order
    clock.lap(buffers_.times.sort);

    bound_lights(camera, grid, counts.kept, options);
    clock.lap(buffers_.times.bounds);

    MlCell* cells = cells_.data() + views_.back().cell_offset;
    options.cell_test == CellTest::tight ? scatter_tight(camera, grid) : scatter_boxes(grid);
    bin_lights(cells, cell_count, !has_trees);
    clock.lap(buffers_.times.bin);
    if (has_trees && !sorts_all(options)) sort_cells(cells, cell_count, options.sort_key);
    clock.lap(buffers_.times.sort);

    if (has_trees) build_trees(camera, options, cells, clock);
    if (has_entries(options)) enter_slices(cells);
    clock.lap(buffers_.times.pack);
}

void PaperPipeline::place_view(const Camera& camera, const Grid& grid, const Options& options) {
    const SliceTable& slices = has_entries(options) ? entry_slices_ : slices_;
    const std::uint64_t cell_count = std::uint64_t{grid.tiles_x} * grid.tiles_y * slices.count();
    if (cell_count_ + cell_count > kMost) throw std::length_error("more than 2^32 - 1 cells");
    MlView view{};
    view.width = camera.width;
    view.height = camera.height;
    view.tile_px = grid.tile_px;
    view.tiles_x = grid.tiles_x;
    view.tiles_y = grid.tiles_y;
    view.slice_count = slices.count();
    view.slice_offset = 0;
    view.cell_offset = std::uint32_t(cell_count_);
    view.cell_count = std::uint32_t(cell_count);
    view.structure = structure_code(options);
    view.slice_scale = slices.guess_scale();
    view.slice_bias = slices.guess_bias();
    views_.push_back(view);
    cells_.require(cell_count_ + cell_count, cell_count_);
    cell_count_ += cell_count;
}

void PaperPipeline::sort_lights(std::uint32_t count, const Options& options) {
    const CulledLight* culled = culled_.data();
    SortPair* pairs = sort_.pairs(count);
    const float offset = options.sort_key == SortKey::near_depth ? 1.0f : 0.0f;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float key = offset != 0.0f ? culled[i].depth - culled[i].radius : culled[i].depth;
        pairs[i] = {sort_key(key), i};
    }
    order_ = sort_.sort(count);
}

void PaperPipeline::bound_lights(const Camera& camera, const Grid& grid, std::uint32_t count, const Options& options) {
    constexpr std::uint32_t kAhead = 16; // sorted lights lie anywhere: fetch them in time
    const bool sorted = sorts_all(options), tight = options.cell_test == CellTest::tight;
    const CulledLight* culled = culled_.data();
    // One beyond: an empty box is written, too.
    CellBox* boxes = boxes_.require(count + std::size_t{1});
    CellLight* cell_lights = cell_lights_.require(count + std::size_t{1});
    CulledLight* bounded = tight ? bounded_.require(count + std::size_t{1}) : nullptr;
    std::uint32_t kept = 0;
    std::uint64_t cells = 0;
    float farthest = 0.0f;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (sorted) prefetch(culled + order_[std::min(i + kAhead, count - 1)].rank);
        const CulledLight& light = culled[sorted ? order_[i].rank : i];
        const bool touches = bound(camera, grid, slices_, light, boxes[kept], cell_lights[kept]);
        if (tight) bounded[kept] = light;
        cells += touches ? boxes[kept].cell_count() : 0;
        farthest = std::max(farthest, cell_lights[kept].max_depth);
        kept += touches;
    }
    bounded_count_ = kept;
    scatter_count_ = cells;
    farthest_ = farthest;
}

void PaperPipeline::scatter_boxes(const Grid& grid) {
    check_reference_count(reference_count_ + scatter_count_);
    write_scatter(boxes_.data(), bounded_count_, grid, scatter_.require(scatter_count_ + kScatterPadding));
}

// Room for whole boxes, one light after the other: together they would be several times what passes.
void PaperPipeline::scatter_tight(const Camera& camera, const Grid& grid) {
    tight_.set_view(camera, grid);
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < bounded_count_; ++i) {
        const CellBox& box = boxes_.data()[i];
        Scatter* scatter = scatter_.require(count + box.cell_count(), count) + count;
        count += tight_.write_scatter(bounded_.data()[i], box, slices_, i, scatter);
        check_reference_count(reference_count_ + count);
    }
    scatter_count_ = count;
}

void PaperPipeline::bin_lights(MlCell* cells, std::uint32_t cell_count, bool as_indices) {
    const std::uint64_t first = reference_count_, end = first + scatter_count_;
    const Scatter* scatter = scatter_.data();
    std::uint32_t* cursors = cursors_.require(cell_count);
    place_cells(scatter, scatter_count_, std::uint32_t(first), cells, cursors, cell_count);
    std::uint32_t* references = references_.require(end, first);
    reference_count_ = end;
    if (!as_indices) return fill_places(scatter, scatter_count_, cursors, references);
    fill_indices(scatter, scatter_count_, cell_lights_.data(), cursors, references);
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) buffers_.list_cells += cells[cell].count != 0;
}

void PaperPipeline::sort_cells(const MlCell* cells, std::uint32_t cell_count, SortKey key) {
    const CellLight* cell_lights = cell_lights_.data();
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) {
        const std::uint32_t count = cells[cell].count;
        std::uint32_t* places = references_.data() + cells[cell].first;
        SortPair* pairs = sort_.pairs(count);
        for (std::uint32_t i = 0; i < count; ++i) pairs[i] = {cell_sort_key(cell_lights[places[i]], key), places[i]};
        const SortPair* sorted = pairs;
        if (count < kFewPairs)
            std::sort(pairs, pairs + count, [](const SortPair& a, const SortPair& b) {
                return a.key != b.key ? a.key < b.key : a.rank < b.rank;
            });
        else
            sorted = sort_.sort(count);
        for (std::uint32_t i = 0; i < count; ++i) places[i] = sorted[i].rank;
    }
}

// Fetches the cell's depth ranges, and turns its references from places into light indices. Neighbours in a cell are
// neighbours in depth, so this reads a window of the sorted lights.
CellLights PaperPipeline::take_cell(const MlCell& cell) {
    const CellLight* cell_lights = cell_lights_.data();
    std::uint32_t* references = references_.data() + cell.first;
    DepthRange* ranges = ranges_.require(cell.count);
    for (std::uint32_t i = 0; i < cell.count; ++i) {
        const CellLight light = cell_lights[references[i]];
        ranges[i] = {light.min_depth, light.max_depth};
        references[i] = light.index;
    }
    return {cell.first, cell.count, ranges};
}

// The open ends as card 7 of the project's specification reads them: slice 0 begins at the near plane, and no slice
// reaches beyond slice_far or the farthest light.
SliceExtent PaperPipeline::slice_extent(const Camera& camera, const Options& options, std::uint32_t slice) const {
    const float farthest = std::min(std::max(options.slice_far, farthest_), std::numeric_limits<float>::max());
    return {std::max(slices_.edges()[slice], camera.near_depth), std::min(slices_.edges()[slice + 1], farthest)};
}

// One row of tiles at a time, so that the breadth-first nodes are still in the cache when they are packed.
void PaperPipeline::build_trees(const Camera& camera, const Options& options, MlCell* cells, StageClock& clock) {
    const MlView& view = views_.back();
    const std::uint32_t tiles = view.tiles_x * view.tiles_y;
    for (std::uint32_t begin = 0; begin < tiles * slices_.count(); begin += view.tiles_x) {
        const SliceExtent extent = slice_extent(camera, options, begin / tiles);
        for (std::uint32_t cell = begin; cell < begin + view.tiles_x; ++cell) {
            const CellLights lights = take_cell(cells[cell]);
            cells[cell] = {std::uint32_t(node_count_) + tree_builder_.node_count(), 0};
            if (lights.count == 0) continue;
            cells[cell].count = tree_builder_.build_cell(lights, extent, options);
            ++(tree_builder_.built_tree() ? buffers_.tree_cells : buffers_.list_cells);
        }
        clock.lap(buffers_.times.tree);
        const std::uint64_t end = node_count_ + tree_builder_.node_count();
        if (end > kMost) throw std::length_error("more than 2^32 - 1 nodes");
        tree_builder_.pack(nodes_.require(end, node_count_) + node_count_);
        node_count_ = end;
        clock.lap(buffers_.times.pack);
    }
}

// The cells of the first slice are the tiles' own until each is replaced. That slice holds depths in front of the
// camera plane as well, as for the query.
void PaperPipeline::enter_slices(MlCell* cells) {
    const MlView& view = views_.back();
    const std::uint32_t tiles = view.tiles_x * view.tiles_y;
    const std::vector<float>& edges = entry_slices_.edges();
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
        const MlCell whole = cells[tile];
        for (std::uint32_t slice = 0; slice < view.slice_count; ++slice) {
            const float lower = slice == 0 ? -std::numeric_limits<float>::infinity() : edges[slice];
            cells[slice * tiles + tile] = entry_in_slice(nodes_.data(), whole, {lower, edges[slice + 1]});
        }
    }
}

} // namespace manylights::paper
