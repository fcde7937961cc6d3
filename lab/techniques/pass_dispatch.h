#pragma once
// What the dispatches of shading_pass.glsl have in common, whatever the form of the shader.

#include "lab/gpu/buffer.h"
#include "lab/techniques/technique.h"

namespace manylights::lab {

/// Bindings 0 to 5 of shading_pass.glsl; the structure's follow.
constexpr std::uint32_t kCommonBuffers = 6;
constexpr std::uint32_t kGroupEdge = 8;

/// The push constants of shading_pass.glsl.
struct PassPush {
    std::uint32_t width, height;
    std::uint32_t first_row, row_count;
    std::uint32_t first_light, end_light;
    std::uint32_t first_block;
};

/// Rows of the image that share the structure's buffers.
struct PassBand {
    std::uint32_t first_row, row_count;
    std::vector<const gpu::Buffer*> structure;
};

/// The whole image with one set of buffers.
std::vector<PassBand> one_band(const Frame& frame, std::span<const gpu::Buffer* const> structure);

/// How many lights a dispatch may take: all, or as many as keep its tests of a light against a pixel below a bound
/// (brute force), so that no submission runs for long.
enum class LightSplit { none, bounded };

struct LightRange {
    std::uint32_t first, end;
};

/// The lights of each dispatch over so many pixels, in order; one dispatch at the least, also without any light.
std::vector<LightRange> light_ranges(LightSplit split, std::uint32_t light_count, std::uint64_t pixels);

} // namespace manylights::lab
