#pragma once
// The pass that shades every point of a frame, with the shader of any technique: pipelines, light buffers, output,
// bounded submissions, timing.

#include "lab/gpu/buffer.h"
#include "lab/gpu/commands.h"
#include "lab/gpu/compute_pipeline.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/technique.h"

namespace manylights::lab {

/// The lights of a frame on the host and on the device.
struct FrameLights {
    FrameLights(gpu::Device& device, const Frame& frame);
    LightStream stream;
    gpu::Buffer spheres, colors;
};

/// The two forms of a technique's shader: `record` writes PixelRecord, `shade` writes three floats per pixel. Bindings
/// are those of shading_pass.glsl, then the structure's.
struct PassShaders {
    std::string name;
    std::span<const std::uint32_t> record, shade;
    std::uint32_t structure_buffers = 0;
};

/// How many lights a dispatch may take: all, or as many as keep its tests of a light against a pixel below a bound
/// (brute force), so that no submission runs for long.
enum class LightSplit { none, bounded };

class ShadingPass {
  public:
    ShadingPass(gpu::Device& device, const PassShaders& shaders, LightSplit split);

    std::vector<PixelRecord> record(const Frame& frame, const FrameLights& lights,
                                    std::span<const gpu::Buffer* const> structure);
    /// Adds one element to shade_ms: the sum of the device's time over all submissions.
    std::vector<float> shade(const Frame& frame, const FrameLights& lights,
                             std::span<const gpu::Buffer* const> structure, std::vector<double>& shade_ms);

  private:
    template <typename T>
    std::vector<T> run(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                       std::span<const gpu::Buffer* const> structure, std::size_t elements_per_pixel,
                       double& milliseconds);
    gpu::ComputePipeline make_pipeline(const PassShaders& shaders, const char* form,
                                       std::span<const std::uint32_t> code);
    void warm_up(const gpu::ComputePipeline& pipeline);

    gpu::Device& device_;
    LightSplit split_;
    gpu::ComputePipeline record_pipeline_, shade_pipeline_;
    bool is_warm_ = false; ///< the shade pipeline has its machine code
};

} // namespace manylights::lab
