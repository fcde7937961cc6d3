#pragma once
// Runs the log form of a technique's shader over the sampled blocks, and makes the waves' figures of what it wrote.

#include "lab/gpu/compute_pipeline.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/pass_dispatch.h"
#include "lab/techniques/wave_cost.h"

#include <functional>

namespace manylights::lab {

/// Bytes of a log that is on the device at one time. A lane that alone needs more gets them: up to the 128 MiB that
/// Vulkan promises for a binding, for 16 million lights.
constexpr std::uint64_t kLogBytes = std::uint64_t{64} << 20;

/// What a run of the log form reads and writes: touch_log.glsl has the same names.
struct LogBuffers {
    const gpu::Buffer &blocks, &places, &ends, &words;
};

/// Runs of the log form over sampled blocks, numbered as they are in the buffer, from `first` to before `end`. Lanes of
/// other blocks may be visited as well.
using LogRun = std::function<void(const LogBuffers& buffers, std::size_t first, std::size_t end)>;

/// name: in messages. tested_by_all: lights that every shaded lane tests without a word in the log. Throws DeviceError
/// where the second of the two runs of a lane touched more or less than the first, InputError where an index does not
/// fit into its word.
WaveSummary find_waves(gpu::Device& device, const std::string& name, const Frame& frame, const LogRun& run,
                       std::uint64_t tested_by_all = 0, std::uint64_t log_bytes = kLogBytes);

struct TouchLogInput {
    const Frame& frame;
    std::uint32_t light_count;
    const gpu::Buffer& spheres;
    std::span<const PassBand> bands;
    LightSplit split = LightSplit::none;
    std::uint64_t tested_by_all = 0; ///< as in the function above
    std::uint64_t log_bytes = kLogBytes;
};

/// The same for the forms of shading_pass.glsl.
WaveSummary find_waves(gpu::Device& device, const gpu::ComputePipeline& pipeline, const TouchLogInput& input);

} // namespace manylights::lab
