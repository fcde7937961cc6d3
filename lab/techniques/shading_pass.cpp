#include "lab/techniques/shading_pass.h"

#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"

#include <algorithm>

namespace manylights::lab {

namespace {

// Bindings 0 to 5 of shading_pass.glsl: positions, normals, materials, spheres, colours, output.
constexpr std::uint32_t kCommonBuffers = 6;
constexpr std::uint32_t kGroupEdge = 8;

// Every bit pattern of the output is this before a dispatch, so that a pixel that no invocation writes is wrong for all
// to see.
constexpr std::uint32_t kPoison = 0xCDCDCDCD;

// Output of one dispatch: below the 128 MiB that Vulkan promises for a binding, and a 1920 x 1080 picture in one piece.
constexpr std::uint64_t kOutputBytes = std::uint64_t{32} << 20;

// Tests of a light against a pixel per submission of brute force: half a second on two CPU cores (about 300 million a
// second), and far below any watchdog on a GPU.
constexpr std::uint64_t kTestsPerSubmission = std::uint64_t{1} << 27;
constexpr std::uint32_t kLightChunk = 256; // of brute_force.glsl

// The push constants of shading_pass.glsl.
struct Push {
    std::uint32_t width, height;
    std::uint32_t first_row, row_count;
    std::uint32_t first_light, end_light;
};

// Rows of one dispatch: whole groups, or the image's rest.
std::uint32_t band_rows(const Frame& frame, std::uint64_t bytes_per_pixel) {
    const std::uint64_t rows = kOutputBytes / (bytes_per_pixel * frame.width) / kGroupEdge * kGroupEdge;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rows, kGroupEdge, frame.height + kGroupEdge));
}

std::uint32_t lights_per_dispatch(LightSplit split, std::uint32_t light_count, std::uint64_t pixels) {
    if (split == LightSplit::none) return std::max(light_count, 1u);
    const std::uint64_t lights = kTestsPerSubmission / std::max<std::uint64_t>(pixels, 1) / kLightChunk * kLightChunk;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(lights, kLightChunk, 0x80000000u));
}

} // namespace

FrameLights::FrameLights(gpu::Device& device, const Frame& frame)
    : stream(make_light_stream(frame)),
      spheres(device, "light spheres", std::span<const glm::vec4>(stream.spheres), gpu::Memory::device),
      colors(device, "light colours", std::span<const glm::vec4>(stream.colors), gpu::Memory::device) {}

ShadingPass::ShadingPass(gpu::Device& device, const PassShaders& shaders, LightSplit split)
    : device_(device), split_(split), record_pipeline_(make_pipeline(shaders, "record", shaders.record)),
      shade_pipeline_(make_pipeline(shaders, "shade", shaders.shade)) {}

gpu::ComputePipeline ShadingPass::make_pipeline(const PassShaders& shaders, const char* form,
                                                std::span<const std::uint32_t> code) {
    gpu::ComputeShader shader;
    shader.name = shaders.name + " (" + form + ")";
    shader.code = code;
    shader.buffer_count = kCommonBuffers + shaders.structure_buffers;
    shader.push_constant_bytes = sizeof(Push);
    return gpu::ComputePipeline(device_, shader);
}

// Drivers make machine code at the first dispatch; one without any pixel keeps that out of the times.
void ShadingPass::warm_up(const gpu::ComputePipeline& pipeline) {
    const gpu::Buffer nothing(device_, "warm-up", 256);
    gpu::Commands commands(device_);
    commands.dispatch(pipeline, std::vector<gpu::Binding>(pipeline.buffer_count(), gpu::Binding{nothing}), Push{},
                      {1, 1, 1});
    commands.submit_and_wait("warm-up");
}

template <typename T>
std::vector<T> ShadingPass::run(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                                std::span<const gpu::Buffer* const> structure, std::size_t elements_per_pixel,
                                double& milliseconds) {
    const std::uint64_t row_bytes = std::uint64_t{frame.width} * elements_per_pixel * sizeof(T);
    const std::uint32_t rows = std::min(band_rows(frame, elements_per_pixel * sizeof(T)), frame.height);
    // A GPU writes to its own memory, and the result is copied; with a software device there is only one memory.
    const gpu::Memory memory = device_.info().is_software ? gpu::Memory::readback : gpu::Memory::device;
    gpu::Buffer output(device_, pipeline.name() + " output", row_bytes * rows, memory);
    std::vector<gpu::Binding> bindings{{frame.points.positions()}, {frame.points.normals()}, {frame.points.materials()},
                                       {lights.spheres},           {lights.colors},          {output}};
    for (const gpu::Buffer* buffer : structure) bindings.push_back({*buffer});

    std::vector<T> result(std::size_t{frame.width} * frame.height * elements_per_pixel);
    milliseconds = 0.0;
    for (std::uint32_t row = 0; row < frame.height; row += rows) {
        const std::uint32_t count = std::min(rows, frame.height - row);
        const std::uint32_t light_count = lights.stream.light_count();
        const std::uint32_t step = lights_per_dispatch(split_, light_count, std::uint64_t{count} * frame.width);
        output.fill(kPoison);
        std::uint32_t light = 0;
        do {
            const std::uint32_t end = light_count - light > step ? light + step : light_count;
            gpu::Commands commands(device_);
            const std::uint32_t start = commands.timestamp();
            commands.dispatch(pipeline, bindings, Push{frame.width, frame.height, row, count, light, end},
                              {gpu::group_count(frame.width, kGroupEdge), gpu::group_count(count, kGroupEdge), 1});
            const std::uint32_t stop = commands.timestamp();
            commands.submit_and_wait(pipeline.name().c_str());
            milliseconds += commands.milliseconds(start, stop);
            light = end;
        } while (light < light_count);
        const std::size_t first = std::size_t{row} * frame.width * elements_per_pixel;
        output.download_bytes(std::as_writable_bytes(
            std::span<T>(result).subspan(first, std::size_t{count} * frame.width * elements_per_pixel)));
    }
    return result;
}

std::vector<PixelRecord> ShadingPass::record(const Frame& frame, const FrameLights& lights,
                                             std::span<const gpu::Buffer* const> structure) {
    double milliseconds = 0.0;
    return run<PixelRecord>(record_pipeline_, frame, lights, structure, 1, milliseconds);
}

std::vector<float> ShadingPass::shade(const Frame& frame, const FrameLights& lights,
                                      std::span<const gpu::Buffer* const> structure, std::vector<double>& shade_ms) {
    if (!is_warm_) warm_up(shade_pipeline_);
    is_warm_ = true;
    double milliseconds = 0.0;
    std::vector<float> radiance = run<float>(shade_pipeline_, frame, lights, structure, 3, milliseconds);
    shade_ms.push_back(milliseconds);
    return radiance;
}

} // namespace manylights::lab
