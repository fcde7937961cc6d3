#include "lab/renderer/point_buffer.h"
#include "lab/techniques/device/spread.h"
#include "lab/techniques/octree/occupied_cells.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kMarkCode[] =
#include "octree_bits_mark.comp.inc"
    ;
constexpr std::uint32_t kBitCountsCode[] =
#include "bit_counts.comp.inc"
    ;
constexpr std::uint32_t kListCode[] =
#include "octree_bits_list.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kCountGroup = 256, kListGroup = 64; // of the shaders

struct MarkPush {
    std::uint32_t width, height;
};

class CellsByBits : public OccupiedCells {
  public:
    explicit CellsByBits(gpu::Device& device)
        : OccupiedCells(device), mark_pipeline_(device, {"octree, bits", kMarkCode, 3, sizeof(MarkPush), {}}),
          count_pipeline_(device, {"counts of bits", kBitCountsCode, 2, kWord, {}}),
          list_pipeline_(device, {"octree, froxels of bits", kListCode, 4, kWord, {}}),
          bits_(device, "bits of froxels"), places_(device, "places of bits") {}

    double find(const Frame& frame, const FroxelGrid& grid) override {
        const std::uint32_t words = grid.tiles().tile_count() * gpu::group_count(grid.slice_count(), 32);
        bits_.fit(kWord * words);
        places_.fit(kWord * words);
        prefix_sum_.reserve(words);
        const double mark_ms = mark(frame, grid, words);
        set_count(total());
        return mark_ms + list(grid, words);
    }

  private:
    double mark(const Frame& frame, const FroxelGrid& grid, std::uint32_t words) {
        const MarkPush push{frame.width, frame.height};
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(mark_pipeline_, {{frame.points.positions()}, {grid.buffer()}, {bits_.buffer()}}, push,
                          {grid.tiles().tiles_x, grid.tiles().tiles_y, 1});
        commands.barrier();
        commands.dispatch(count_pipeline_, {{bits_.buffer()}, {places_.buffer()}}, words,
                          spread_groups(gpu::group_count(words, kCountGroup)));
        prefix_sum_.record(commands, places_.buffer(), places_.buffer(), words, total_.buffer());
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("marking froxels with samples");
        return commands.milliseconds(start, end);
    }

    double list(const FroxelGrid& grid, std::uint32_t words) {
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(list_pipeline_, {{bits_.buffer()}, {places_.buffer()}, {grid.buffer()}, {cells()}}, words,
                          spread_groups(gpu::group_count(words, kListGroup)));
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("listing froxels with samples");
        return commands.milliseconds(start, end);
    }

    gpu::ComputePipeline mark_pipeline_, count_pipeline_, list_pipeline_;
    FittedBuffer bits_, places_;
};

} // namespace

std::unique_ptr<OccupiedCells> make_cells_by_bits(gpu::Device& device) { return std::make_unique<CellsByBits>(device); }

} // namespace manylights::lab
