#include "lab/techniques/depth_windows/depth_pruning.h"

#include "lab/renderer/point_buffer.h"

#include <manylights/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kMarkCode[] =
#include "depth_mark.comp.inc"
    ;
constexpr std::uint32_t kShapeCode[] =
#include "depth_shape.comp.inc"
    ;
constexpr std::uint32_t kWriteCode[] =
#include "depth_write.comp.inc"
    ;

constexpr std::uint32_t kPoison = 0xCDCDCDCD;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint64_t kSpanBytes = 2 * kWord;  // of a tile, uvec2
constexpr std::uint64_t kShapeBytes = 5 * kWord; // of a tile, TileShape of depth_shape.glsl
constexpr std::uint32_t kShapeGroup = 64;
constexpr const char* kNames[5] = {"pruned views", "pruned slice edges", "pruned cells", "pruned nodes",
                                   "pruned references"};

gpu::Buffer poisoned(gpu::Device& device, const char* name, std::uint64_t bytes,
                     gpu::Memory memory = gpu::Memory::device) {
    gpu::Buffer buffer(device, name, bytes, memory);
    buffer.fill(kPoison);
    return buffer;
}

std::array<std::uint32_t, 3> group_per_tile(const MlView& view) { return {view.tiles_x, view.tiles_y, 1}; }

} // namespace

DepthPruning::Scratch::Scratch(gpu::Device& device, std::uint32_t tiles, std::uint32_t references)
    : tile_count(tiles), reference_count(references),
      ranks(poisoned(device, "ranks of references", kWord * (std::uint64_t{references} + 1))),
      spans(poisoned(device, "slices with points", kSpanBytes * tiles)),
      shapes(poisoned(device, "shapes of tiles", kShapeBytes * tiles)),
      entry_places(poisoned(device, "places of entries", kWord * (std::uint64_t{tiles} + 1))),
      kept_references(poisoned(device, "kept references", kWord, gpu::Memory::readback)),
      kept_entries(poisoned(device, "kept entries", kWord, gpu::Memory::readback)) {}

DepthPruning::DepthPruning(gpu::Device& device)
    : device_(device), mark_pipeline_(device, {"depth windows (mark)", kMarkCode, 6, 4, {}}),
      shape_pipeline_(device, {"depth windows (shape)", kShapeCode, 6, 0, {}}),
      write_pipeline_(device, {"depth windows (write)", kWriteCode, 9, 0, {}}), prefix_sum_(device) {}

BuiltStructure DepthPruning::prune(const PointBuffer& points, const BuiltStructure& built) {
    const MlView view = built.buffers[0]->download<MlView>().at(0);
    const std::uint32_t tiles = view.tiles_x * view.tiles_y;
    const auto references = static_cast<std::uint32_t>(built.references);
    if (!scratch_ || scratch_->tile_count != tiles || scratch_->reference_count != references)
        scratch_.emplace(device_, tiles, references);
    prefix_sum_.reserve(std::max(tiles, references) + 1);

    milliseconds_ = count(points, built, view);
    const std::uint64_t kept = scratch_->kept_references.download<std::uint32_t>().at(0);
    const std::uint64_t entries = scratch_->kept_entries.download<std::uint32_t>().at(0);
    reserve({sizeof(MlView), 0, sizeof(MlCell) * (2 * std::uint64_t{tiles} + entries), 0, 2 * kWord * kept});
    milliseconds_ += write(built, view);
    BuiltStructure result{{}, kept};
    for (std::size_t i = 0; i < pruned_.size(); ++i) result.buffers[i] = &pruned_[i];
    return result;
}

// Up to the sizes of the result; how many words before each are kept turns into places in the same buffers.
double DepthPruning::count(const PointBuffer& points, const BuiltStructure& built, const MlView& view) {
    Scratch& scratch = scratch_.value();
    const gpu::Buffer &views = *built.buffers[0], &cells = *built.buffers[2], &references = *built.buffers[4];
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(mark_pipeline_,
                      {{views}, {cells}, {references}, {points.positions()}, {scratch.ranks}, {scratch.spans}},
                      scratch.reference_count, group_per_tile(view));
    prefix_sum_.record(commands, scratch.ranks, scratch.ranks, scratch.reference_count + 1, scratch.kept_references);
    commands.dispatch(shape_pipeline_,
                      {{views}, {cells}, {scratch.ranks}, {scratch.spans}, {scratch.shapes}, {scratch.entry_places}},
                      std::span<const std::byte>(), {gpu::group_count(scratch.tile_count + 1, kShapeGroup), 1, 1});
    prefix_sum_.record(commands, scratch.entry_places, scratch.entry_places, scratch.tile_count + 1,
                       scratch.kept_entries);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("counting what the points need");
    return commands.milliseconds(start, end);
}

// Buffers that have these sizes already stay as they are, as those of the producer do.
void DepthPruning::reserve(const std::array<std::uint64_t, 5>& bytes) {
    if (!pruned_.empty() && bytes == pruned_bytes_) return;
    pruned_.clear();
    pruned_bytes_ = bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i) pruned_.push_back(poisoned(device_, kNames[i], bytes[i]));
}

double DepthPruning::write(const BuiltStructure& built, const MlView& view) {
    const Scratch& scratch = scratch_.value();
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(write_pipeline_,
                      {{*built.buffers[0]},
                       {*built.buffers[2]},
                       {scratch.ranks},
                       {scratch.shapes},
                       {scratch.entry_places},
                       {*built.buffers[4]},
                       {pruned_[0]},
                       {pruned_[2]},
                       {pruned_[4]}},
                      std::span<const std::byte>(), group_per_tile(view));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("writing what the points need");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
