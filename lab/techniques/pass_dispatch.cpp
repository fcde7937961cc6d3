#include "lab/techniques/pass_dispatch.h"

#include <algorithm>

namespace manylights::lab {

namespace {

// Tests of a light against a pixel per submission of brute force: half a second on two CPU cores (about 300 million a
// second), and far below any watchdog on a GPU.
constexpr std::uint64_t kTestsPerSubmission = std::uint64_t{1} << 27;
constexpr std::uint32_t kLightChunk = 256; // of brute_force.glsl

std::uint32_t lights_per_dispatch(LightSplit split, std::uint32_t light_count, std::uint64_t pixels) {
    if (split == LightSplit::none) return std::max(light_count, 1u);
    const std::uint64_t lights = kTestsPerSubmission / std::max<std::uint64_t>(pixels, 1) / kLightChunk * kLightChunk;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(lights, kLightChunk, 0x80000000u));
}

} // namespace

std::vector<PassBand> one_band(const Frame& frame, std::span<const gpu::Buffer* const> structure) {
    return {{0, frame.height, {structure.begin(), structure.end()}}};
}

std::vector<LightRange> light_ranges(LightSplit split, std::uint32_t light_count, std::uint64_t pixels) {
    const std::uint32_t step = lights_per_dispatch(split, light_count, pixels);
    std::vector<LightRange> ranges;
    std::uint32_t first = 0;
    do {
        const std::uint32_t end = light_count - first > step ? first + step : light_count;
        ranges.push_back({first, end});
        first = end;
    } while (first < light_count);
    return ranges;
}

} // namespace manylights::lab
