#include "lab/techniques/device_build/cell_trees.h"

#include "lab/techniques/device/spread.h"

#include <manylights/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCostCode[] =
#include "trees_cost.comp.inc"
    ;
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
    : device_(device), leaf_size_(options.leaf_size),
      asks_cost_(options.kind == StructureKind::hybrid && options.heuristic == paper::Heuristic::expected_cost),
      prefix_sum_(device), cost_pipeline_(device, {"costs of trees", kCostCode, 8, sizeof(SizePush), {}}),
      size_pipeline_(device, {"nodes of cells, their number",
                              kSizeCode,
                              10,
                              sizeof(SizePush),
                              {static_cast<std::uint32_t>(options.heuristic), options.kind == StructureKind::hybrid}}),
      build_pipeline_(
          device,
          {"nodes of cells", kBuildCode, 8, sizeof(BuildPush), {static_cast<std::uint32_t>(options.list_bounds)}}),
      costs_(device, "costs of trees"), kinds_(device, "kinds of cells"), counts_(device, "nodes of each cell"),
      places_(device, "places of nodes"), total_(device, "number of nodes"), nodes_(device, "nodes") {}

double CellTrees::build(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                        const GridReferences& references, const DepthEnds& ends) {
    for (FittedBuffer* buffer : {&kinds_, &counts_, &places_}) buffer->fit(grid.cell_count() * kWord);
    costs_.fit((asks_cost_ ? grid.cell_count() : 1) * kWord);
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
    const SizePush push{cell_count, grid.tiles.tile_count(), leaf_size_, ends};
    std::vector<gpu::Binding> inputs = references;
    inputs.push_back({grid.slice_edges});
    inputs.push_back({farthest});
    std::vector<gpu::Binding> cost_bindings = inputs, size_bindings = inputs;
    cost_bindings.push_back({costs_.buffer()});
    for (const FittedBuffer* buffer : {&kinds_, &counts_, &costs_}) size_bindings.push_back({buffer->buffer()});
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    if (asks_cost_) commands.dispatch(cost_pipeline_, cost_bindings, push, spread_groups(cell_count));
    commands.barrier();
    commands.dispatch(size_pipeline_, size_bindings, push, spread_groups(gpu::group_count(cell_count, kGroupSize)));
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
