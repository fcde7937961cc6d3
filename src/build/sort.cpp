#include "src/build/sort.h"

#include <bit>
#include <cmath>

namespace manylights::detail {

namespace {

constexpr int kPasses = 4;
constexpr std::uint32_t kBuckets = 256;

std::uint32_t digit(std::uint32_t key, int pass) { return (key >> (8 * pass)) & (kBuckets - 1); }

struct Histograms {
    std::uint32_t counts[kPasses][kBuckets];
};

void count_digits(const Array<SortItem>& items, Histograms& histograms) {
    histograms = {};
    for (std::size_t i = 0; i < items.size(); ++i)
        for (int pass = 0; pass < kPasses; ++pass) ++histograms.counts[pass][digit(items[i].key, pass)];
}

// Stable: items of one bucket keep their order.
void scatter(const Array<SortItem>& from, Array<SortItem>& to, const std::uint32_t (&counts)[kBuckets], int pass) {
    std::uint32_t next[kBuckets];
    std::uint32_t sum = 0;
    for (std::uint32_t b = 0; b < kBuckets; ++b) {
        next[b] = sum;
        sum += counts[b];
    }
    for (std::size_t i = 0; i < from.size(); ++i) to[next[digit(from[i].key, pass)]++] = from[i];
}

} // namespace

std::uint32_t sortable_key(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

// The depths are widened by 1.25 * 2^-20: 2^-20 that a caller's depth may be off, and three roundings of 2^-24.
VisibleLight visible_light(const LightBlock& lights, std::uint32_t at, const Slices& slices) {
    constexpr float kWidening = 1.25f * 0x1p-20f;
    const float low = lights.depth[at] - lights.radius[at];
    const float high = lights.depth[at] + lights.radius[at];
    VisibleLight light{};
    light.index = lights.index[at];
    light.min_depth = low - std::fabs(low) * kWidening;
    light.max_depth = high + std::fabs(high) * kWidening;
    light.center_depth = lights.depth[at];
    const std::uint32_t pixels[2] = {lights.pixels_x[at], lights.pixels_y[at]};
    for (int i = 0; i < 2; ++i) {
        light.first_px[i] = static_cast<std::uint16_t>(pixels[i] & 0xFFFF);
        light.last_px[i] = static_cast<std::uint16_t>(pixels[i] >> 16);
    }
    light.first_slice = static_cast<std::uint8_t>(slice_of(slices, light.min_depth));
    light.last_slice = static_cast<std::uint8_t>(slice_of(slices, light.max_depth));
    return light;
}

bool list_lights(ViewLights& view, const Slices& slices, Array<VisibleLight>& lights) {
    if (!lights.resize(view.count)) return false;
    std::uint64_t next = 0;
    for (std::uint64_t b = 0; b < view.block_count(); ++b) {
        const LightBlock block = view.block(b);
        for (std::uint32_t i = 0; i < block.count; ++i) lights[next++] = visible_light(block, i, slices);
    }
    return true;
}

bool append_sorted(const Array<VisibleLight>& lights, Array<SortItem> (&items)[2], Array<VisibleLight>& sorted) {
    const std::size_t count = lights.size();
    const std::size_t base = sorted.size();
    if (!items[0].resize(count) || !items[1].resize(count) || !sorted.resize(base + count)) return false;
    for (std::size_t i = 0; i < count; ++i)
        items[0][i] = {sortable_key(lights[i].center_depth), static_cast<std::uint32_t>(i)};

    Histograms histograms;
    count_digits(items[0], histograms);
    for (int pass = 0; pass < kPasses; ++pass)
        scatter(items[pass % 2], items[1 - pass % 2], histograms.counts[pass], pass);
    static_assert(kPasses % 2 == 0, "the result is back in items[0]");
    for (std::size_t i = 0; i < count; ++i) sorted[base + i] = lights[items[0][i].position];
    return true;
}

} // namespace manylights::detail
