// What a sample of the lights says about all of them: the scale of depths, the size of tiles, the room for records. All
// of it is only a matter of speed and memory: what is saturated, too coarse or too small loses no light. So a sample
// will do, evenly spread over the caller's lights; up to kSampleLights it is all of them.
#include "src/build/record_stages.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace manylights::detail {

namespace {

constexpr std::uint32_t kSampleLights = 2048;
// While a light spans more tiles than this on average, larger ones cost less than they save. Its pixels are a
// rectangle: it has references in about 12 of 14 tiles.
constexpr double kTilesPerLight = 14.0;
constexpr std::uint64_t kVeryManyLights = 500000;

static_assert(kSampleLights <= kBlockLights);

LightBlock sample_block(TileRecords& records, std::uint32_t view) {
    float* const floats = records.sample_floats.data() + 4 * kBlockRoom * std::size_t{view};
    std::uint32_t* const words = records.sample_words.data() + 4 * kBlockRoom * std::size_t{view};
    LightBlock block = lay_out_block(floats, words + kBlockRoom, words);
    block.count = words[3 * kBlockRoom];
    return block;
}

// One light of each step, at an uneven place in it: the caller's lights may have an order of their own.
std::uint32_t copy_sample(const ManylightsLights& lights, std::uint32_t step, ManylightsSphere* to) {
    const LightSpan whole = whole_span(lights);
    std::uint32_t count = 0;
    for (std::uint64_t begin = 0; begin < lights.count; begin += step) {
        const std::uint64_t width = std::min<std::uint64_t>(step, lights.count - begin);
        const std::uint64_t at = begin + (std::uint64_t{count * 0x9E3779B9u} * width >> 32);
        std::memcpy(to + count++, whole.spheres + at * whole.stride, sizeof(ManylightsSphere));
    }
    return count;
}

// Of positive floats, by their exponents; all others are in the first bin.
struct Exponents {
    std::uint32_t counts[256] = {};
    void add(float value) { ++counts[value > 0.0f ? std::bit_cast<std::uint32_t>(value) >> 23 : 0]; }
};

// The last bin with which no more than one of so many are left out.
int last_bin(const std::uint32_t (&exponents)[256], std::uint64_t one_of) {
    std::uint64_t count = 0;
    for (const std::uint32_t bin : exponents) count += bin;
    std::uint64_t beyond = 0; // in the bins behind last
    int last = 255;
    while (last > 0 && beyond + exponents[last] <= count / one_of) beyond += exponents[last--];
    return last;
}

float scale_of(const LightBlock& lights) {
    Exponents near_ends;
    for (std::uint32_t i = 0; i < lights.count; ++i) near_ends.add(lights.depth[i] - lights.radius[i]);
    return choose_depth_scale(near_ends.counts);
}

float power_of_two(int bin) { return std::bit_cast<float>(static_cast<std::uint32_t>(std::clamp(bin, 1, 254)) << 23); }

// One of sixteen may begin nearer, one of 64 lie farther, and one of 64 be larger: see DepthCodes and DepthBands.
void measure_depths(const LightBlock& lights, LightSample& sample) {
    if (lights.count == 0) return;
    Exponents depths, near_ends, radii;
    for (std::uint32_t i = 0; i < lights.count; ++i) {
        depths.add(lights.depth[i]);
        radii.add(lights.radius[i]);
        near_ends.add(lights.depth[i] - lights.radius[i]);
    }
    int first = 0;
    for (std::uint32_t before = 0; first < 255 && before <= lights.count / 16; ++first)
        before += near_ends.counts[first];
    sample.least_depth = power_of_two(first - 1);
    sample.most_depth = power_of_two(last_bin(depths.counts, 64) + 2);
    sample.large_radius = power_of_two(last_bin(radii.counts, 64) + 1);
}

std::uint32_t chosen_tile_px(ManylightsBuilder& builder) {
    bool very_many = false;
    double visible = 0.0;
    std::uint32_t largest_side = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const LightSample& sample = builder.records.samples[v];
        very_many = very_many || sample.visible >= kVeryManyLights;
        visible += static_cast<double>(sample.visible);
        largest_side = std::max({largest_side, builder.grids[v].width, builder.grids[v].height});
    }
    std::uint32_t tile_px = very_many ? 24 : 32;
    while (tile_px<largest_side&& static_cast<double>(estimate_tiles(builder, tile_px))> kTilesPerLight * visible)
        tile_px *= 2;
    return tile_px;
}

} // namespace

float choose_depth_scale(const std::uint32_t (&exponents)[256]) {
    constexpr int kLargestExponent = 126; // of a scale in this format
    const int exponent = std::min(18 - (last_bin(exponents, 1024) - 126), kLargestExponent);
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

bool take_sample(ManylightsBuilder& builder, const ManylightsLights& lights) {
    TileRecords& records = builder.records;
    const std::size_t room = 4 * kBlockRoom * std::size_t{builder.view_count};
    if (!records.sample_floats.resize(room) || !records.sample_words.resize(room) ||
        !records.sample_spheres.resize(kSampleLights))
        return false;
    const std::uint32_t step = std::max(divide_up(lights.count, kSampleLights), 1u);
    const LightSpan span = {reinterpret_cast<const char*>(records.sample_spheres.data()), sizeof(ManylightsSphere), 0,
                            copy_sample(lights, step, records.sample_spheres.data())};
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        LightBlock block = sample_block(records, v);
        cull_block(make_view_cull(builder.views[v].camera, lights.motion_margin), span, block);
        records.sample_words[(4 * std::size_t{v} + 3) * kBlockRoom] = block.count;
        records.samples[v] = {span.count != 0 ? std::uint64_t{block.count} * lights.count / span.count : 0,
                              static_cast<double>(step), 0.0f, 0.0f, 0.0f};
        measure_depths(block, records.samples[v]);
        if (has_windows(builder)) builder.windows.views[v].depth_scale = scale_of(block);
    }
    return true;
}

LightBlock sample_lights(ManylightsBuilder& builder, std::uint32_t view) { return sample_block(builder.records, view); }

std::uint64_t estimate_tiles(ManylightsBuilder& builder, std::uint32_t tile_px) {
    double sum = 0.0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const SpanView view = {tile_px, builder.grids[v].width - 1, builder.grids[v].height - 1};
        sum += static_cast<double>(count_tiles(view, sample_block(builder.records, v))) *
               builder.records.samples[v].weight;
    }
    return static_cast<std::uint64_t>(sum);
}

std::uint32_t first_tile_px(ManylightsBuilder& builder) {
    return builder.settings.tile_px != 0 ? builder.settings.tile_px : chosen_tile_px(builder);
}

} // namespace manylights::detail
