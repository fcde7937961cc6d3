#include "lab/techniques/shading_pass.h"

#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"

#include <algorithm>

namespace manylights::lab {

namespace {

// Every bit pattern of the output is this before a dispatch, so that a pixel that no invocation writes is wrong for all
// to see.
constexpr std::uint32_t kPoison = 0xCDCDCDCD;

// Output of one dispatch: below the 128 MiB that Vulkan promises for a binding, and a 1920 x 1080 picture in one piece.
constexpr std::uint64_t kOutputBytes = std::uint64_t{32} << 20;

const std::vector<std::uint32_t> kWaveOf64{64}, kWaveOf32{32};

// Rows of one dispatch: whole groups, or the image's rest.
std::uint32_t band_rows(const Frame& frame, std::uint64_t bytes_per_pixel) {
    const std::uint64_t rows = kOutputBytes / (bytes_per_pixel * frame.width) / kGroupEdge * kGroupEdge;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rows, kGroupEdge, frame.height + kGroupEdge));
}

// The band in pieces of so many rows.
std::vector<PassBand> pieces_of(const PassBand& band, std::uint32_t rows) {
    std::vector<PassBand> pieces;
    for (std::uint32_t row = 0; row < band.row_count; row += rows)
        pieces.push_back({band.first_row + row, std::min(rows, band.row_count - row), band.structure});
    return pieces;
}

} // namespace

FrameLights::FrameLights(gpu::Device& device, const Frame& frame)
    : stream(make_light_stream(frame)),
      spheres(device, "light spheres", std::span<const glm::vec4>(stream.spheres), gpu::Memory::device),
      colors(device, "light colours", std::span<const glm::vec4>(stream.colors), gpu::Memory::device) {}

ShadingPass::ShadingPass(gpu::Device& device, const PassShaders& shaders, LightSplit split)
    : device_(device), split_(split),
      record_pipeline_(make_pipeline(shaders, "record", shaders.record, shaders.constants)),
      shade_pipeline_(make_pipeline(shaders, "shade", shaders.shade, shaders.constants)),
      log_pipeline_(
          make_pipeline(shaders, "log", shaders.log, shaders.log_has_wave_size ? kWaveOf64 : shaders.constants)) {
    if (shaders.log_has_wave_size) log_32_pipeline_ = make_pipeline(shaders, "log", shaders.log, kWaveOf32);
}

gpu::ComputePipeline ShadingPass::make_pipeline(const PassShaders& shaders, const char* form,
                                                std::span<const std::uint32_t> code,
                                                const std::vector<std::uint32_t>& constants) {
    gpu::ComputeShader shader;
    shader.name = shaders.name + " (" + form + ")";
    shader.code = code;
    shader.buffer_count = kCommonBuffers + shaders.structure_buffers;
    shader.push_constant_bytes = sizeof(PassPush);
    shader.specialization = constants;
    return gpu::ComputePipeline(device_, shader);
}

// Drivers make machine code at the first dispatch; one without any pixel keeps that out of the times.
void ShadingPass::warm_up(const gpu::ComputePipeline& pipeline) {
    const gpu::Buffer nothing(device_, "warm-up", 256);
    gpu::Commands commands(device_);
    commands.dispatch(pipeline, std::vector<gpu::Binding>(pipeline.buffer_count(), gpu::Binding{nothing}), PassPush{},
                      {1, 1, 1});
    commands.submit_and_wait("warm-up");
}

// The device's time over all submissions, in milliseconds.
double ShadingPass::dispatch(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                             const PassBand& rows, const gpu::Buffer& output) {
    std::vector<gpu::Binding> bindings{{frame.points.positions()}, {frame.points.normals()}, {frame.points.materials()},
                                       {lights.spheres},           {lights.colors},          {output}};
    for (const gpu::Buffer* buffer : rows.structure) bindings.push_back({*buffer});
    double milliseconds = 0.0;
    const std::uint64_t pixels = std::uint64_t{rows.row_count} * frame.width;
    for (const LightRange range : light_ranges(split_, lights.stream.light_count(), pixels)) {
        const PassPush push{frame.width, frame.height, rows.first_row, rows.row_count, range.first, range.end, 0};
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(pipeline, bindings, push,
                          {gpu::group_count(frame.width, kGroupEdge), gpu::group_count(rows.row_count, kGroupEdge), 1});
        const std::uint32_t stop = commands.timestamp();
        commands.submit_and_wait(pipeline.name().c_str());
        milliseconds += commands.milliseconds(start, stop);
    }
    return milliseconds;
}

template <typename T>
std::vector<T> ShadingPass::run(const gpu::ComputePipeline& pipeline, const Frame& frame, const FrameLights& lights,
                                std::span<const PassBand> bands, std::size_t elements_per_pixel, double& milliseconds) {
    const std::uint64_t row_bytes = std::uint64_t{frame.width} * elements_per_pixel * sizeof(T);
    const std::uint32_t rows = std::min(band_rows(frame, elements_per_pixel * sizeof(T)), frame.height);
    // A GPU writes to its own memory, and the result is copied; with a software device there is only one memory.
    const gpu::Memory memory = device_.info().is_software ? gpu::Memory::readback : gpu::Memory::device;
    gpu::Buffer output(device_, pipeline.name() + " output", row_bytes * rows, memory);

    std::vector<T> result(std::size_t{frame.width} * frame.height * elements_per_pixel);
    milliseconds = 0.0;
    for (const PassBand& band : bands) {
        for (const PassBand& piece : pieces_of(band, rows)) {
            output.fill(kPoison);
            milliseconds += dispatch(pipeline, frame, lights, piece, output);
            const std::size_t row_elements = std::size_t{frame.width} * elements_per_pixel;
            output.download_bytes(std::as_writable_bytes(
                std::span<T>(result).subspan(piece.first_row * row_elements, piece.row_count * row_elements)));
        }
    }
    return result;
}

std::vector<PixelRecord> ShadingPass::record(const Frame& frame, const FrameLights& lights,
                                             std::span<const PassBand> bands) {
    double milliseconds = 0.0;
    return run<PixelRecord>(record_pipeline_, frame, lights, bands, 1, milliseconds);
}

std::vector<float> ShadingPass::shade(const Frame& frame, const FrameLights& lights, std::span<const PassBand> bands,
                                      std::vector<double>& shade_ms) {
    if (!is_warm_) warm_up(shade_pipeline_);
    is_warm_ = true;
    double milliseconds = 0.0;
    std::vector<float> radiance = run<float>(shade_pipeline_, frame, lights, bands, 3, milliseconds);
    shade_ms.push_back(milliseconds);
    return radiance;
}

WaveSummary ShadingPass::waves(const Frame& frame, const FrameLights& lights, std::span<const PassBand> bands,
                               std::uint64_t tested_by_all, std::uint64_t log_bytes) {
    const TouchLogInput input{frame,    lights.stream.light_count(), lights.spheres, bands, split_, tested_by_all,
                              log_bytes};
    WaveSummary summary = find_waves(device_, log_pipeline_, input);
    if (log_32_pipeline_) summary.lanes_32 = find_waves(device_, *log_32_pipeline_, input).lanes_32;
    return summary;
}

} // namespace manylights::lab
