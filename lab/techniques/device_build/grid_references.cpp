#include "lab/techniques/device_build/grid_references.h"

#include "lab/scene/error.h"
#include "lab/techniques/device/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCountCode[] =
#include "cells_count.comp.inc"
    ;
constexpr std::uint32_t kPairsCode[] =
#include "cells_pairs.comp.inc"
    ;

constexpr std::uint32_t kDepthsCode[] =
#include "depths_of_references.comp.inc"
    ;
constexpr std::uint32_t kInOrderCode[] =
#include "references_in_order.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64, kDepthBits = 32;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

struct CountPush {
    TileGrid tiles;
    std::uint32_t slice_count, light_count;
};

struct PairsPush {
    TileGrid tiles;
    std::uint32_t slice_count, light_count, pair_count;
};

} // namespace

GridReferences::GridReferences(gpu::Device& device, std::string name)
    : device_(device), name_(std::move(name)), prefix_sum_(device), sort_(device),
      count_pipeline_(device, {"cells of lights", kCountCode, 5, sizeof(CountPush), {}}),
      pairs_pipeline_(device, {"pairs of cells and lights", kPairsCode, 7, sizeof(PairsPush), {}}),
      depths_pipeline_(device, {"depths of references", kDepthsCode, 4, sizeof(std::uint32_t), {}}),
      in_order_pipeline_(device, {"references by depth", kInOrderCode, 5, sizeof(std::uint32_t), {}}),
      light_counts_(device, "cells of each light"), light_places_(device, "places of lights' pairs"),
      farthest_(device, "the farthest light"), total_(device, "number of references"),
      cells_(device, "cells of references"), ranks_(device, "ranks of references"),
      cell_counts_(device, "references of each cell"), cell_places_(device, "places of cells"),
      depths_(device, "depths of references"), numbers_(device, "order of references"),
      unordered_cells_(device, "cells of unordered references"),
      unordered_ranks_(device, "ranks of unordered references") {}

double GridReferences::find(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                            paper::SortScope scope) {
    if (grid.cell_count() > gpu::PrefixSum::kMaxCount)
        throw InputError(fmt::format("{}: {} cells; at most {} can be built on the device: larger tiles or fewer "
                                     "slices need fewer",
                                     name_, grid.cell_count(), gpu::PrefixSum::kMaxCount));
    const double milliseconds = count_cells(grid, lights, order);
    take_count(lights.count());
    return milliseconds + scatter(grid, lights, order, scope);
}

double GridReferences::count_cells(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order) {
    for (FittedBuffer* buffer : {&light_counts_, &light_places_}) buffer->fit(lights.count() * kWord);
    for (FittedBuffer* buffer : {&farthest_, &total_}) buffer->fit(kWord);
    prefix_sum_.reserve(std::max(lights.count(), static_cast<std::uint32_t>(grid.cell_count())));
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(farthest_.buffer(), 0);
    commands.barrier();
    if (lights.count() != 0) {
        commands.dispatch(
            count_pipeline_,
            {{lights.lights()}, {order.order()}, {grid.slice_edges}, {light_counts_.buffer()}, {farthest_.buffer()}},
            CountPush{grid.tiles, grid.slice_count, lights.count()},
            {gpu::group_count(lights.count(), kGroupSize), 1, 1});
        prefix_sum_.record(commands, light_counts_.buffer(), light_places_.buffer(), lights.count(), total_.buffer());
    }
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("cells of lights");
    return commands.milliseconds(start, end);
}

// The device's own sum is modulo 2^32, so the host's decides.
void GridReferences::take_count(std::uint32_t lights) {
    const std::vector<std::uint32_t> counts = light_counts_.buffer().download<std::uint32_t>(lights);
    const std::uint64_t sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    if (sum > gpu::RadixSort::kMaxCount)
        throw InputError(fmt::format("{}: {} references; at most {} can be sorted on the device: larger tiles or fewer "
                                     "slices need fewer",
                                     name_, sum, gpu::RadixSort::kMaxCount));
    count_ = static_cast<std::uint32_t>(sum);
}

double GridReferences::scatter(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                               paper::SortScope scope) {
    const auto cell_count = static_cast<std::uint32_t>(grid.cell_count());
    for (FittedBuffer* buffer : {&cells_, &ranks_}) buffer->fit(count_ * kWord);
    for (FittedBuffer* buffer : {&cell_counts_, &cell_places_}) buffer->fit(cell_count * kWord);
    sort_.reserve(count_);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(cell_counts_.buffer(), 0);
    commands.barrier();
    if (count_ != 0) {
        record_pairs(commands, grid, lights, order);
        if (scope == paper::SortScope::each_cell) record_depth_sort(commands, order);
        const auto bits = static_cast<std::uint32_t>(std::bit_width(cell_count - 1));
        sort_.record(commands, cells_.buffer(), ranks_.buffer(), count_, std::max(bits, 1u));
    }
    prefix_sum_.record(commands, cell_counts_.buffer(), cell_places_.buffer(), cell_count, total_.buffer());
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("references of cells");
    return commands.milliseconds(start, end);
}

void GridReferences::record_pairs(gpu::Commands& commands, const CellGrid& grid, const VisibleLights& lights,
                                  const DepthOrder& order) {
    commands.dispatch(pairs_pipeline_,
                      {{lights.lights()},
                       {order.order()},
                       {grid.slice_edges},
                       {light_places_.buffer()},
                       {cells_.buffer()},
                       {ranks_.buffer()},
                       {cell_counts_.buffer()}},
                      PairsPush{grid.tiles, grid.slice_count, lights.count(), count_},
                      spread_groups(gpu::group_count(count_, kGroupSize)));
    commands.barrier();
}

// All references by depth; the sort by cell, which follows and is stable, then leaves each cell in that order.
void GridReferences::record_depth_sort(gpu::Commands& commands, const DepthOrder& order) {
    const std::array<std::uint32_t, 3> groups = spread_groups(gpu::group_count(count_, kGroupSize));
    for (FittedBuffer* buffer : {&depths_, &numbers_, &unordered_cells_, &unordered_ranks_})
        buffer->fit(count_ * kWord);
    commands.dispatch(depths_pipeline_,
                      {{ranks_.buffer()}, {order.unsorted_keys()}, {depths_.buffer()}, {numbers_.buffer()}}, count_,
                      groups);
    commands.copy(cells_.buffer(), unordered_cells_.buffer(), count_ * kWord);
    commands.copy(ranks_.buffer(), unordered_ranks_.buffer(), count_ * kWord);
    sort_.record(commands, depths_.buffer(), numbers_.buffer(), count_, kDepthBits);
    commands.dispatch(in_order_pipeline_,
                      {{numbers_.buffer()},
                       {unordered_cells_.buffer()},
                       {unordered_ranks_.buffer()},
                       {cells_.buffer()},
                       {ranks_.buffer()}},
                      count_, groups);
}

} // namespace manylights::lab
