// The boxes of all visible lights, by depth: a counting sort, see DepthBands. Each task counts and places the lights of
// its own blocks; lights of one band stay in the caller's order, whatever the tasks.
#include "src/build/record_stages.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::detail {

namespace {

// More bands than one for each few lights take longer to sum than the order gains.
constexpr std::uint64_t kLightsPerBand = 8;
constexpr std::uint64_t kLeastBands = 256, kMostBands = 16384;

struct BoxJob {
    ManylightsBuilder& builder;
    const ManylightsLights& lights;
    std::uint64_t blocks;
    std::uint32_t band_count; // of all views
    ViewCull culls[kMaxViews];
    BoxView boxes[kMaxViews];
};

// For nearly all lights, and for the slices: a light must not reach one because its code says no better.
DepthCodes codes_for(const ManylightsBuilder& builder, const LightSample& sample) {
    const Slices& slices = builder.slices;
    if (slices.count == 1) return make_depth_codes(sample.least_depth, sample.most_depth);
    return make_depth_codes(std::min(sample.least_depth, slices.edges[1]),
                            std::max(sample.most_depth, slices.edges[slices.count - 1]));
}

std::uint32_t band_count_for(const LightSample& sample) {
    return static_cast<std::uint32_t>(std::clamp(sample.visible / kLightsPerBand, kLeastBands, kMostBands));
}

// For eight octaves beyond nearly all lights, and 24 before.
DepthCodes band_codes_for(const LightSample& sample) {
    constexpr int kShift = 8;
    const float top = std::min(256.0f * sample.most_depth, std::numeric_limits<float>::max());
    return {std::max((std::bit_cast<std::int32_t>(top) >> kShift) + 1 - DepthCodes::kMostLow, 0), 0, kShift};
}

// The bands of the codes. Half of them have as many of the sampled lights each; the other half are spread evenly, for
// no sample knows where there are no lights.
void make_bands(const LightBlock& sample, const DepthBands& bands, std::uint32_t* steps) {
    std::fill_n(steps, kBandSteps + 1, 0u);
    for (std::uint32_t i = 0; i < sample.count; ++i) ++steps[bands.codes.code_of(sample.depth[i]) >> kBandShift];
    const std::uint64_t half = (bands.count - 1) / 2;
    std::uint64_t before = 0;
    for (std::uint32_t s = 0; s <= kBandSteps; ++s) {
        const std::uint32_t here = steps[s];
        steps[s] = static_cast<std::uint32_t>(before * half / std::max(sample.count, 1u) + s * half / kBandSteps);
        before += here;
    }
}

// A block's boxes among those of all views.
BlockBoxes boxes_of(Cells& cells, std::uint64_t blocks, std::uint32_t view, std::uint64_t block) {
    const std::size_t at = (view * blocks + block) * kBlockRoom;
    return {cells.found.data() + at, cells.found_bands.data() + at};
}

LightBlock scratch_block(Cells& cells, std::uint32_t task, std::uint32_t* index) {
    return lay_out_block(cells.block_floats.data() + kBlockFloats * task,
                         cells.block_pixels.data() + kBlockPixels * task, index);
}

// False: out of memory.
bool prepare_boxes(BoxJob& job, std::uint32_t task_count) {
    ManylightsBuilder& builder = job.builder;
    Cells& cells = builder.cells;
    job.band_count = 0;
    if (!cells.band_steps.resize((kBandSteps + std::size_t{1}) * builder.view_count)) return false;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const LightSample& sample = builder.records.samples[v];
        const std::uint32_t band_count = band_count_for(sample);
        std::uint32_t* const steps = cells.band_steps.data() + (kBandSteps + std::size_t{1}) * v;
        cells.codes[v] = codes_for(builder, sample);
        const DepthBands bands = {job.band_count, band_count, sample.large_radius, band_codes_for(sample), steps};
        make_bands(sample_lights(builder, v), bands, steps);
        job.culls[v] = make_view_cull(builder.views[v].camera, job.lights.motion_margin);
        job.boxes[v] = {grid.tile_px,
                        grid.tiles_x,
                        static_cast<std::uint32_t>(grid.tile_count),
                        static_cast<std::uint32_t>(grid.cell_offset()),
                        &builder.slices,
                        cells.codes[v],
                        bands};
        job.band_count += band_count + (band_count >> kLargeShift);
        if (!builder.views[v].lights.resize(job.blocks)) return false;
    }
    const std::size_t room = std::size_t{builder.view_count} * job.blocks * kBlockRoom;
    return cells.found.resize(room) && cells.found_bands.resize(room) && cells.box_tasks.resize(task_count) &&
           cells.bands.resize(std::size_t{job.band_count} * task_count) &&
           cells.block_floats.resize(kBlockFloats * task_count) && cells.block_pixels.resize(kBlockPixels * task_count);
}

void box_task(const BoxJob& job, std::uint32_t task) {
    ManylightsBuilder& builder = job.builder;
    Cells& cells = builder.cells;
    std::uint32_t* const counts = cells.bands.data() + std::size_t{job.band_count} * task;
    std::fill_n(counts, job.band_count, 0u);
    BoxTask result{};
    const Part part = part_of(job.blocks, task, static_cast<std::uint32_t>(cells.box_tasks.size()));
    for (std::uint64_t b = part.begin; b < part.end; ++b) {
        Ignored bad{}; // the same for all views
        for (std::uint32_t v = 0; v < builder.view_count; ++v) {
            ViewLights& visible = builder.views[v].lights;
            LightBlock block = scratch_block(cells, task, visible.index.data() + b * kBlockRoom);
            bad = cull_block(job.culls[v], block_span(job.lights, b), block);
            visible.counts[b] = block.count;
            const BlockBoxes to = boxes_of(cells, job.blocks, v, b);
            box_block(job.boxes[v], block, to, result.sums[v]);
            for (std::uint32_t i = 0; i < block.count; ++i) ++counts[to.bands[i]];
        }
        result.ignored = add_ignored(result.ignored, bad);
    }
    cells.box_tasks[task] = result;
}

// Where each task's lights of each band begin.
void sum_bands(const BoxJob& job) {
    ManylightsBuilder& builder = job.builder;
    Cells& cells = builder.cells;
    std::uint32_t place = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const DepthBands& bands = job.boxes[v].bands;
        cells.first_light[v] = place;
        const std::uint32_t end = v + 1 < builder.view_count ? job.boxes[v + 1].bands.first : job.band_count;
        for (std::uint32_t band = bands.first; band < end; ++band) {
            for (std::size_t task = 0; task < cells.box_tasks.size(); ++task) {
                std::uint32_t& here = cells.bands[task * job.band_count + band];
                const std::uint32_t count = here;
                here = place;
                place += count;
            }
        }
    }
    cells.first_light[builder.view_count] = place;
}

// First places, then boxes, see flush in deal_lights.cpp.
void place_block(const BlockBoxes& from, std::uint32_t count, std::uint32_t* next, LightBox* boxes) {
    constexpr std::uint32_t kTogether = 256; // so many are still in the cache when they are written
    std::uint32_t* const places = from.bands;
    for (std::uint32_t begin = 0; begin < count; begin += kTogether) {
        const std::uint32_t end = std::min(begin + kTogether, count);
        for (std::uint32_t i = begin; i < end; ++i) {
            places[i] = next[from.bands[i]]++;
            hwy::Prefetch(boxes + places[i]);
        }
        for (std::uint32_t i = begin; i < end; ++i) boxes[places[i]] = from.boxes[i];
    }
}

void place_task(const BoxJob& job, std::uint32_t task) {
    ManylightsBuilder& builder = job.builder;
    Cells& cells = builder.cells;
    std::uint32_t* const next = cells.bands.data() + std::size_t{job.band_count} * task;
    const Part part = part_of(job.blocks, task, static_cast<std::uint32_t>(cells.box_tasks.size()));
    for (std::uint64_t b = part.begin; b < part.end; ++b)
        for (std::uint32_t v = 0; v < builder.view_count; ++v)
            place_block(boxes_of(cells, job.blocks, v, b), builder.views[v].lights.counts[b], next, cells.boxes.data());
}

} // namespace

bool order_boxes(ManylightsBuilder& builder, const ManylightsLights& lights) {
    Cells& cells = builder.cells;
    BoxJob job{builder, lights, block_count_for(lights.count), 0, {}, {}};
    const std::uint32_t task_count = task_count_for(builder.settings, job.blocks, 1);
    if (!prepare_boxes(job, task_count)) return false;
    run_tasks(builder.settings, task_count, [&](std::uint32_t task) { box_task(job, task); });
    sum_bands(job);
    const std::size_t visible = cells.first_light[builder.view_count] + std::size_t{kLanePadding};
    if (!cells.boxes.resize(visible)) return false;
    run_tasks(builder.settings, task_count, [&](std::uint32_t task) { place_task(job, task); });
    return finish_culling(builder, cells.box_tasks);
}

} // namespace manylights::detail
