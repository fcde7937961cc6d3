#include "lab/techniques/z_bins/z_bins.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"
#include "lab/techniques/device/depth_order.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"
#include "lab/techniques/z_bins/depth_bins.h"
#include "lab/techniques/z_bins/masks_size.h"

#include <bit>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSpansCode[] =
#include "z_bins_spans.comp.inc"
    ;
constexpr std::uint32_t kLevelCode[] =
#include "z_bins_level.comp.inc"
    ;
constexpr std::uint32_t kMasksCode[] =
#include "z_bins_masks.comp.inc"
    ;
constexpr std::uint32_t kLaneRecordCode[] =
#include "z_bins_lane_record.comp.inc"
    ;
constexpr std::uint32_t kLaneShadeCode[] =
#include "z_bins_lane_shade.comp.inc"
    ;
constexpr std::uint32_t kLaneLogCode[] =
#include "z_bins_lane_log.comp.inc"
    ;
constexpr std::uint32_t kWaveRecordCode[] =
#include "z_bins_wave_record.comp.inc"
    ;
constexpr std::uint32_t kWaveShadeCode[] =
#include "z_bins_wave_shade.comp.inc"
    ;
constexpr std::uint32_t kWaveLogCode[] =
#include "z_bins_wave_log.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64, kBlockEdge = 8;

struct Options {
    std::uint32_t tile_size, bins;
    bool is_log, has_summary, is_wave, by_near_end;
};

std::uint32_t chosen(const OptionReader& reader, const char* key, std::span<const char* const> choices,
                     std::uint32_t lowest, std::uint32_t fallback) {
    return reader.given(key) ? lowest << reader.choice(key, choices) : fallback;
}

Options read_options(const OptionValues& values) {
    const OptionReader reader(z_bins_info(), values);
    constexpr const char *kTileSizes[] = {"8", "16", "32", "64"}, *kBins[] = {"1024", "2048", "4096", "8192"};
    constexpr const char *kSpacings[] = {"linear", "log"}, *kSummaries[] = {"off", "on"}, *kLoops[] = {"lane", "wave"},
                         *kSortKeys[] = {"centre", "near"};
    return {chosen(reader, "tile_size", kTileSizes, 8, 32),
            chosen(reader, "bins", kBins, 1024, 8192),
            reader.choice("spacing", kSpacings) == 1,
            reader.choice("summary", kSummaries) == 1,
            reader.choice("loop", kLoops) == 1,
            reader.choice("sort_key", kSortKeys) == 1};
}

// What a wave of so many lanes touches is counted with emulated waves of that size, whatever the device's own are.
PassShaders shaders_of(const Options& options, const gpu::DeviceInfo& device) {
    if (!options.is_wave) return {"z_bins", kLaneRecordCode, kLaneShadeCode, kLaneLogCode, 5};
    if (!device.has_wave_operations)
        throw DeviceError("z_bins: option loop=wave: the device " + device.name + " lacks subgroup arithmetic");
    return {"z_bins", kWaveRecordCode, kWaveShadeCode, kWaveLogCode, 5, {}, true};
}

/// Of z_bins.glsl.
struct Header {
    DepthBins bins;
    std::uint32_t tile_size, tiles_across, words, summary;
};

struct SpansPush {
    DepthBins bins;
    std::uint32_t light_count;
};

struct LevelPush {
    std::uint32_t bin_count, level;
};

struct MasksPush {
    DeviceView view;
    std::uint32_t tiles_x, tiles_y, tile_size, light_count;
};

class ZBins : public PassTechnique {
  public:
    ZBins(gpu::Device& device, const Options& options)
        : PassTechnique(device, z_bins_info(), shaders_of(options, device.info())), options_(options), visible_(device),
          depth_order_(device, options.by_near_end),
          spans_pipeline_(device, {"z_bins, spans", kSpansCode, 4, sizeof(SpansPush), {}}),
          level_pipeline_(device, {"z_bins, levels", kLevelCode, 1, sizeof(LevelPush), {}}),
          masks_pipeline_(device, {"z_bins, masks", kMasksCode, 5, sizeof(MasksPush), {options.has_summary}}),
          levels_(device, "depth bins"), ranked_(device, "lights by rank"), masks_(device, "masks of tiles"),
          summaries_(device, "summaries of masks"), bit_counts_(device, "bits of masks"), header_(device, "z_bins") {}

  protected:
    void build(const Frame& frame) override;
    std::vector<const gpu::Buffer*> structure() const override {
        return {&header_.buffer(), &levels_.buffer(), &masks_.buffer(), &summaries_.buffer(), &ranked_.buffer()};
    }

  private:
    DepthBins bins_of(const Frame& frame) const;
    void fit(const Frame& frame);
    void record_bins(gpu::Commands& commands);
    void record_masks(gpu::Commands& commands, const DeviceView& view);
    void count();

    // A span of bins is at most all of them, and they are a power of two.
    std::uint32_t top_level() const { return static_cast<std::uint32_t>(std::countr_zero(options_.bins)); }
    std::uint64_t mask_bytes() const { return size_.tiles() * size_.words * sizeof(std::uint32_t); }
    std::uint64_t summary_bytes() const {
        return options_.has_summary ? size_.tiles() * size_.summary * sizeof(std::uint32_t) : 0;
    }

    Options options_;
    VisibleLights visible_;
    DepthOrder depth_order_;
    gpu::ComputePipeline spans_pipeline_, level_pipeline_, masks_pipeline_;
    FittedBuffer levels_, ranked_, masks_, summaries_, bit_counts_, header_;
    MasksSize size_{};
    DepthBins bins_{};
};

DepthBins ZBins::bins_of(const Frame& frame) const {
    const float far_depth = frame.scene.view_extent;
    return options_.is_log ? log_bins(options_.bins, frame.camera.near_plane, far_depth)
                           : linear_bins(options_.bins, far_depth);
}

void ZBins::fit(const Frame& frame) {
    const std::uint64_t lights = visible_.count();
    size_ = masks_size(frame.width, frame.height, options_.tile_size, visible_.count());
    bins_ = bins_of(frame);
    ranked_.fit(lights * sizeof(std::uint32_t));
    depth_order_.reserve(visible_.count());
    levels_.fit(std::uint64_t{top_level() + 1} * options_.bins * sizeof(std::uint64_t));
    masks_.fit(mask_bytes());
    summaries_.fit(summary_bytes());
    bit_counts_.fit(size_.summary * sizeof(std::uint32_t));
    header_.fit(sizeof(Header));
    const Header header{bins_, options_.tile_size, size_.tiles_x, size_.words,
                        options_.has_summary ? size_.summary : 0};
    header_.buffer().upload(std::span<const Header>(&header, 1));
}

void ZBins::record_bins(gpu::Commands& commands) {
    const std::uint32_t lights = visible_.count();
    commands.dispatch(spans_pipeline_,
                      {{visible_.lights()}, {depth_order_.order()}, {levels_.buffer()}, {ranked_.buffer()}},
                      SpansPush{bins_, lights}, {gpu::group_count(lights, kGroupSize), 1, 1});
    for (std::uint32_t level = top_level(); level > 0; --level) {
        commands.barrier();
        commands.dispatch(level_pipeline_, {{levels_.buffer()}}, LevelPush{options_.bins, level},
                          {gpu::group_count(options_.bins, kGroupSize), 1, 1});
    }
}

void ZBins::record_masks(gpu::Commands& commands, const DeviceView& view) {
    commands.dispatch(
        masks_pipeline_,
        {{visible_.lights()}, {depth_order_.order()}, {masks_.buffer()}, {summaries_.buffer()}, {bit_counts_.buffer()}},
        MasksPush{view, size_.tiles_x, size_.tiles_y, options_.tile_size, visible_.count()},
        {gpu::group_count(size_.tiles_x, kBlockEdge), gpu::group_count(size_.tiles_y, kBlockEdge), size_.summary});
}

void ZBins::build(const Frame& frame) {
    const DeviceView view = device_view(frame);
    const double find_ms = visible_.find(view, spheres(), light_count());
    fit(frame);
    gpu::Commands commands(device());
    const std::uint32_t start = commands.timestamp();
    commands.fill(levels_.buffer(), 0xFFFFFFFFu);
    commands.fill(bit_counts_.buffer(), 0);
    commands.barrier();
    if (visible_.count() != 0) {
        depth_order_.record(commands, visible_);
        record_bins(commands);
        record_masks(commands, view);
    }
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("z_bins");
    stats_.build_ms.push_back(find_ms + commands.milliseconds(start, end));
    count();
}

// The levels above the bins are scratch; nothing reads them when the frame is shaded.
void ZBins::count() {
    const std::vector<std::uint32_t> counts = bit_counts_.buffer().download<std::uint32_t>();
    stats_.visible_lights = visible_.count();
    stats_.references = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    stats_.structure_bytes = sizeof(Header) + options_.bins * sizeof(std::uint64_t) + mask_bytes() + summary_bytes() +
                             ranked_.buffer().bytes();
}

} // namespace

TechniqueInfo z_bins_info() {
    TechniqueInfo info;
    info.name = "z_bins";
    info.summary = "lights sorted by depth: a range of ranks per depth bin, a bit per light and tile";
    info.options = {
        {"tile_size", "edge of a tile in pixels", "8, 16, 32 (default), 64"},
        {"bins", "depth bins", "1024, 2048, 4096, 8192 (default)"},
        {"spacing", "where the bins' edges are", "linear (default): even from 0 to the scene's view distance; log"},
        {"summary", "a bit per word of the masks, so that empty words are skipped", "off (default), on"},
        {"loop", "who walks a range of ranks", "lane (default): each lane its own; wave: all lanes those of all"},
        {"sort_key", "the depth that lights are sorted by", "centre (default), near: of the sphere's near end"}};
    return info;
}

std::unique_ptr<Technique> make_z_bins(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<ZBins>(device, read_options(options));
}

} // namespace manylights::lab
