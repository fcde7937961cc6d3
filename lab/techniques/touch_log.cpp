#include "lab/techniques/touch_log.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "lab/scene/error.h"

namespace manylights::lab {

namespace {

/// Lanes are numbered through the sampled blocks, 64 each.
struct LaneRange {
    std::size_t first, end;
};

class TouchLog {
  public:
    TouchLog(gpu::Device& device, const std::string& name, const Frame& frame, const LogRun& run)
        : device_(device), name_(name), run_(run), blocks_(sampled_blocks(frame.width, frame.height)),
          block_buffer_(device, "log blocks", std::span<const std::uint32_t>(blocks_)),
          place_buffer_(device, "log places", lane_count() * sizeof(std::uint32_t)),
          end_buffer_(device, "log ends", lane_count() * sizeof(std::uint32_t)) {}

    WaveSummary find(std::uint64_t tested_by_all, std::uint64_t log_bytes) {
        const std::vector<std::uint32_t> counts = count();
        WaveUnions unions(tested_by_all);
        for (std::size_t lane = 0; lane < counts.size();) {
            const LaneRange lanes = next_group(counts, lane, log_bytes / sizeof(MlUint));
            fill(counts, lanes, unions);
            lane = lanes.end;
        }
        return unions.finish();
    }

  private:
    std::size_t lane_count() const { return blocks_.size() * kBlockLanes; }
    std::vector<std::uint32_t> count();
    static LaneRange next_group(const std::vector<std::uint32_t>& counts, std::size_t first, std::uint64_t most);
    void fill(const std::vector<std::uint32_t>& counts, LaneRange lanes, WaveUnions& unions);
    void dispatch(LaneRange lanes, const gpu::Buffer& words) const {
        run_({block_buffer_, place_buffer_, end_buffer_, words}, lanes.first / kBlockLanes,
             (lanes.end + kBlockLanes - 1) / kBlockLanes);
    }

    gpu::Device& device_;
    const std::string& name_;
    const LogRun& run_;
    std::vector<std::uint32_t> blocks_;
    gpu::Buffer block_buffer_, place_buffer_, end_buffer_;
};

// The ends stay at 0, so that nothing is written.
std::vector<std::uint32_t> TouchLog::count() {
    place_buffer_.fill(0);
    end_buffer_.fill(0);
    dispatch({0, lane_count()}, gpu::Buffer(device_, "log words", 0));
    return place_buffer_.download<std::uint32_t>();
}

LaneRange TouchLog::next_group(const std::vector<std::uint32_t>& counts, std::size_t first, std::uint64_t most) {
    std::size_t end = first;
    std::uint64_t words = 0;
    while (end < counts.size() && (end == first || words + counts[end] <= most)) words += counts[end++];
    return {first, end};
}

// Lanes outside the group have their end at 0, as when they were counted.
void TouchLog::fill(const std::vector<std::uint32_t>& counts, LaneRange lanes, WaveUnions& unions) {
    std::vector<std::uint32_t> places(counts.size()), ends(counts.size());
    std::uint64_t total = 0;
    for (std::size_t lane = lanes.first; lane < lanes.end; ++lane) {
        places[lane] = static_cast<std::uint32_t>(total);
        total += counts[lane];
        ends[lane] = static_cast<std::uint32_t>(total);
    }
    const gpu::Memory memory = device_.info().is_software ? gpu::Memory::readback : gpu::Memory::device;
    const gpu::Buffer words(device_, "log words", total * sizeof(MlUint), memory);
    place_buffer_.upload(places);
    end_buffer_.upload(ends);
    dispatch(lanes, words);
    const auto reached = place_buffer_.download<std::uint32_t>();
    const auto log = words.download<MlUint>();
    for (std::size_t lane = lanes.first; lane < lanes.end; ++lane) {
        if (reached[lane] != ends[lane])
            throw DeviceError(name_ + ": a pixel touched " + std::to_string(reached[lane] - places[lane]) +
                              " things, and " + std::to_string(counts[lane]) + " when they were counted");
        unions.add(lane, std::span(log).subspan(places[lane], counts[lane]));
    }
}

/// Dispatches of a shader of shading_pass.glsl, band by band.
class BandRuns {
  public:
    BandRuns(gpu::Device& device, const gpu::ComputePipeline& pipeline, const TouchLogInput& input)
        : device_(device), pipeline_(pipeline), input_(input),
          blocks_(sampled_blocks(input.frame.width, input.frame.height)) {}

    void operator()(const LogBuffers& buffers, std::size_t first, std::size_t end) const;

  private:
    std::uint32_t first_row(std::size_t block) const;
    bool meets(const PassBand& band, std::size_t block) const;
    void dispatch(const PassBand& band, std::uint32_t first_block, std::uint32_t block_count,
                  const LogBuffers& buffers) const;

    gpu::Device& device_;
    const gpu::ComputePipeline& pipeline_;
    const TouchLogInput& input_;
    std::vector<std::uint32_t> blocks_;
};

std::uint32_t BandRuns::first_row(std::size_t block) const {
    return blocks_[block] / gpu::group_count(input_.frame.width, kBlockEdge) * kBlockEdge;
}

bool BandRuns::meets(const PassBand& band, std::size_t block) const {
    return first_row(block) < band.first_row + band.row_count && first_row(block) + kBlockEdge > band.first_row;
}

void BandRuns::operator()(const LogBuffers& buffers, std::size_t first, std::size_t end) const {
    for (const PassBand& band : input_.bands) {
        std::size_t from = first, to = end;
        while (from < to && !meets(band, from)) ++from; // blocks come row by row
        while (from < to && !meets(band, to - 1)) --to;
        if (from < to) dispatch(band, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from), buffers);
    }
}

void BandRuns::dispatch(const PassBand& band, std::uint32_t first_block, std::uint32_t block_count,
                        const LogBuffers& buffers) const {
    std::vector<gpu::Binding> bindings{{input_.frame.points.positions()},
                                       {buffers.blocks},
                                       {buffers.places},
                                       {input_.spheres},
                                       {buffers.ends},
                                       {buffers.words}};
    for (const gpu::Buffer* buffer : band.structure) bindings.push_back({*buffer});
    const std::uint64_t pixels = std::uint64_t{block_count} * kBlockLanes;
    for (const LightRange lights : light_ranges(input_.split, input_.light_count, pixels)) {
        const PassPush push{input_.frame.width, input_.frame.height, band.first_row, band.row_count,
                            lights.first,       lights.end,          first_block};
        gpu::Commands commands(device_);
        commands.dispatch(pipeline_, bindings, push, {block_count, 1, 1});
        commands.submit_and_wait(pipeline_.name().c_str());
    }
}

} // namespace

WaveSummary find_waves(gpu::Device& device, const std::string& name, const Frame& frame, const LogRun& run,
                       std::uint64_t tested_by_all, std::uint64_t log_bytes) {
    return TouchLog(device, name, frame, run).find(tested_by_all, log_bytes);
}

WaveSummary find_waves(gpu::Device& device, const gpu::ComputePipeline& pipeline, const TouchLogInput& input) {
    return find_waves(device, pipeline.name(), input.frame, BandRuns(device, pipeline, input), input.tested_by_all,
                      input.log_bytes);
}

} // namespace manylights::lab
