#include "lab/gpu/radix_sort.h"
#include "lab/renderer/point_buffer.h"
#include "lab/techniques/device/spread.h"
#include "lab/techniques/octree/occupied_cells.h"

#include <bit>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kKeysCode[] =
#include "octree_keys.comp.inc"
    ;
constexpr std::uint32_t kHeadsCode[] =
#include "octree_heads.comp.inc"
    ;
constexpr std::uint32_t kCompactCode[] =
#include "octree_compact.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kPixelGroup = 8, kKeyGroup = 256; // of the shaders

struct KeysPush {
    std::uint32_t width, height, sky;
};

struct HeadsPush {
    std::uint32_t key_count, sky;
};

/// Keys of all pixels row by row, or those of them that differ from the one before, sorted; then again those that
/// differ.
class CellsBySort : public OccupiedCells {
  public:
    CellsBySort(gpu::Device& device, bool is_compacted_first)
        : OccupiedCells(device), is_compacted_first_(is_compacted_first), sort_(device),
          keys_pipeline_(device, {"octree, keys", kKeysCode, 3, sizeof(KeysPush), {}}),
          heads_pipeline_(device, {"octree, heads of keys", kHeadsCode, 2, sizeof(HeadsPush), {}}),
          compact_pipeline_(device, {"octree, keys that differ", kCompactCode, 3, kWord, {}}),
          keys_(device, "froxels of pixels"), kept_(device, "froxels of pixels that differ"),
          values_(device, "sorted with froxels, and not read"), heads_(device, "heads of froxels") {}

    double find(const Frame& frame, const FroxelGrid& grid) override {
        const std::uint32_t pixels = frame.width * frame.height, sky = grid.froxel_count();
        keys_.fit(kWord * pixels);
        double milliseconds = find_keys(frame, grid);
        const gpu::Buffer* keys = &keys_.buffer();
        std::uint32_t count = pixels;
        if (is_compacted_first_) {
            milliseconds += mark_heads(*keys, count, sky);
            kept_.fit(kWord * total());
            milliseconds += compact(*keys, count, kept_.buffer());
            keys = &kept_.buffer();
            count = total();
        }
        milliseconds += sort(*keys, count, sky);
        milliseconds += mark_heads(*keys, count, sky);
        set_count(total());
        return milliseconds + compact(*keys, count, cells());
    }

  private:
    template <typename Record>
    double run(const char* what, Record record) {
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        record(commands);
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait(what);
        return commands.milliseconds(start, end);
    }

    double find_keys(const Frame& frame, const FroxelGrid& grid) {
        return run("froxels of pixels", [&](gpu::Commands& commands) {
            const KeysPush push{frame.width, frame.height, grid.froxel_count()};
            commands.dispatch(
                keys_pipeline_, {{frame.points.positions()}, {grid.buffer()}, {keys_.buffer()}}, push,
                {gpu::group_count(frame.width, kPixelGroup), gpu::group_count(frame.height, kPixelGroup), 1});
        });
    }

    double sort(const gpu::Buffer& keys, std::uint32_t count, std::uint32_t greatest) {
        values_.fit(keys.bytes());
        sort_.reserve(count);
        return run("sorting froxels", [&](gpu::Commands& commands) {
            sort_.record(commands, keys, values_.buffer(), count, static_cast<std::uint32_t>(std::bit_width(greatest)));
        });
    }

    double mark_heads(const gpu::Buffer& keys, std::uint32_t count, std::uint32_t sky) {
        heads_.fit(kWord * (std::uint64_t{count} + 1));
        prefix_sum_.reserve(count + 1);
        return run("marking froxels that differ", [&](gpu::Commands& commands) {
            commands.dispatch(heads_pipeline_, {{keys}, {heads_.buffer()}}, HeadsPush{count, sky},
                              spread_groups(gpu::group_count(count + 1, kKeyGroup)));
            prefix_sum_.record(commands, heads_.buffer(), heads_.buffer(), count + 1, total_.buffer());
        });
    }

    double compact(const gpu::Buffer& keys, std::uint32_t count, const gpu::Buffer& target) {
        return run("listing froxels that differ", [&](gpu::Commands& commands) {
            commands.dispatch(compact_pipeline_, {{keys}, {heads_.buffer()}, {target}}, count,
                              spread_groups(gpu::group_count(count, kKeyGroup)));
        });
    }

    bool is_compacted_first_;
    gpu::RadixSort sort_;
    gpu::ComputePipeline keys_pipeline_, heads_pipeline_, compact_pipeline_;
    FittedBuffer keys_, kept_, values_, heads_;
};

} // namespace

std::unique_ptr<OccupiedCells> make_cells_by_sort(gpu::Device& device, bool is_compacted_first) {
    return std::make_unique<CellsBySort>(device, is_compacted_first);
}

} // namespace manylights::lab
