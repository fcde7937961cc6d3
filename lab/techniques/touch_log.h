#pragma once
// Runs the log form of a technique's shader over the sampled blocks, and makes the waves' figures of what it wrote.

#include "lab/gpu/compute_pipeline.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/pass_dispatch.h"
#include "lab/techniques/wave_cost.h"

namespace manylights::lab {

/// Bytes of a log that is on the device at one time. A lane that alone needs more gets them: up to the 128 MiB that
/// Vulkan promises for a binding, for 16 million lights.
constexpr std::uint64_t kLogBytes = std::uint64_t{64} << 20;

struct TouchLogInput {
    const Frame& frame;
    std::uint32_t light_count;
    const gpu::Buffer& spheres;
    std::span<const PassBand> bands;
    LightSplit split = LightSplit::none;
    std::uint64_t tested_by_all = 0; ///< lights that every shaded lane tests without a word in the log
    std::uint64_t log_bytes = kLogBytes;
};

/// Throws DeviceError where the second of the two runs of a lane touched more or less than the first, InputError where
/// an index does not fit into its word.
WaveSummary find_waves(gpu::Device& device, const gpu::ComputePipeline& pipeline, const TouchLogInput& input);

} // namespace manylights::lab
