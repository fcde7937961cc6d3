#pragma once
// The pass that shades every point of a frame, with the shader of any technique: pipelines, light buffers, output,
// bounded submissions, timing.

#include "lab/gpu/buffer.h"
#include "lab/gpu/commands.h"
#include "lab/gpu/compute_pipeline.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/touch_log.h"

#include <optional>

namespace manylights::lab {

/// The lights of a frame on the host and on the device.
struct FrameLights {
    FrameLights(gpu::Device& device, const Frame& frame);
    LightStream stream;
    gpu::Buffer spheres, colors;
};

/// The forms of a technique's shader: `record` writes PixelRecord, `shade` writes three floats per pixel, `log` writes
/// what the lanes of sampled waves touch. Bindings are those of shading_pass.glsl, then the structure's.
struct PassShaders {
    std::string name;
    std::span<const std::uint32_t> record, shade, log;
    std::uint32_t structure_buffers = 0;
    std::vector<std::uint32_t> constants{}; ///< specialization constants
    /// The lanes of a wave work together, so that what they touch depends on its size: the one constant of the log
    /// form, which is run for waves of 64 and of 32.
    bool log_has_wave_size = false;
};

class ShadingPass {
  public:
    ShadingPass(gpu::Device& device, const PassShaders& shaders, LightSplit split);

    /// bands: from the first row to the last, together the whole image.
    std::vector<PixelRecord> record(const Frame& frame, const FrameLights& lights, std::span<const PassBand> bands);
    /// Adds one element to shade_ms: the sum of the device's time over all submissions.
    std::vector<float> shade(const Frame& frame, const FrameLights& lights, std::span<const PassBand> bands,
                             std::vector<double>& shade_ms);
    /// tested_by_all, log_bytes: as in TouchLogInput.
    WaveSummary waves(const Frame& frame, const FrameLights& lights, std::span<const PassBand> bands,
                      std::uint64_t tested_by_all = 0, std::uint64_t log_bytes = kLogBytes);

  private:
    template <typename T>
    std::vector<T> run(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                       std::span<const PassBand> bands, std::size_t elements_per_pixel, double& milliseconds);
    double dispatch(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                    const PassBand& rows, const gpu::Buffer& output);
    gpu::ComputePipeline make_pipeline(const PassShaders& shaders, const char* form,
                                       std::span<const std::uint32_t> code,
                                       const std::vector<std::uint32_t>& constants);
    void warm_up(const gpu::ComputePipeline& pipeline);

    gpu::Device& device_;
    LightSplit split_;
    gpu::ComputePipeline record_pipeline_, shade_pipeline_, log_pipeline_;
    std::optional<gpu::ComputePipeline> log_32_pipeline_; ///< where log_pipeline_ is for waves of 64 only
    bool is_warm_ = false;                                ///< the shade pipeline has its machine code
};

} // namespace manylights::lab
