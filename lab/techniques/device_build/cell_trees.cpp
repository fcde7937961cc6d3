#include "lab/techniques/device_build/cell_trees.h"

#include "lab/techniques/device/spread.h"

#include <manylights/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSizeCode[] =
#include "trees_size.comp.inc"
    ;
constexpr std::uint32_t kBuildCode[] =
#include "trees_build.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

struct SizePush {
    std::uint32_t cell_count, tile_count, leaf_size;
    DepthEnds ends;
};

struct BuildPush {
    std::uint32_t cell_count, leaf_size;
};

} // namespace

CellTrees::CellTrees(gpu::Device& device, const StructureOptions& options)
    : device_(device), leaf_size_(options.leaf_size), prefix_sum_(device),
      size_pipeline_(device, {"nodes of cells, their number",
                              kSizeCode,
                              9,
                              sizeof(SizePush),
                              {static_cast<std::uint32_t>(options.heuristic), options.kind == StructureKind::hybrid}}),
      build_pipeline_(
          device,
          {"nodes of cells", kBuildCode, 8, sizeof(BuildPush), {static_cast<std::uint32_t>(options.list_bounds)}}),
      kinds_(device, "kinds of cells"), counts_(device, "nodes of each cell"), places_(device, "places of nodes"),
      total_(device, "number of nodes"), nodes_(device, "nodes") {}

double CellTrees::build(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                        const GridReferences& references, const DepthEnds& ends) {
    for (FittedBuffer* buffer : {&kinds_, &counts_, &places_}) buffer->fit(grid.cell_count() * kWord);
    total_.fit(kWord);
    prefix_sum_.reserve(static_cast<std::uint32_t>(grid.cell_count()));
    const std::vector<gpu::Binding> bindings{
        {lights.lights()}, {order.order()}, {references.ranks()}, {references.counts()}, {references.places()}};
    const double size_ms = find_sizes(grid, bindings, references.farthest(), ends);
    nodes_.fit(total_.buffer().download<std::uint32_t>(1).front() * std::uint64_t{sizeof(MlNode)});
    return size_ms + write_nodes(grid, bindings);
}

// Their sum fits 32 bits: a cell has less than four nodes per reference, and there are 2^26 of these at most.
double CellTrees::find_sizes(const CellGrid& grid, const std::vector<gpu::Binding>& references,
                             const gpu::Buffer& farthest, const DepthEnds& ends) {
    const auto cell_count = static_cast<std::uint32_t>(grid.cell_count());
    std::vector<gpu::Binding> bindings = references;
    for (const gpu::Buffer* buffer :
         {&grid.slice_edges, &farthest, &std::as_const(kinds_).buffer(), &std::as_const(counts_).buffer()})
        bindings.push_back({*buffer});
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(size_pipeline_, bindings, SizePush{cell_count, grid.tiles.tile_count(), leaf_size_, ends},
                      spread_groups(gpu::group_count(cell_count, kGroupSize)));
    prefix_sum_.record(commands, counts_.buffer(), places_.buffer(), cell_count, total_.buffer());
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("nodes of cells, their number");
    return commands.milliseconds(start, end);
}

double CellTrees::write_nodes(const CellGrid& grid, std::vector<gpu::Binding> bindings) {
    const auto cell_count = static_cast<std::uint32_t>(grid.cell_count());
    for (const FittedBuffer* buffer : {&kinds_, &places_, &nodes_}) bindings.push_back({buffer->buffer()});
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(build_pipeline_, bindings, BuildPush{cell_count, leaf_size_}, spread_groups(cell_count));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("nodes of cells");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
