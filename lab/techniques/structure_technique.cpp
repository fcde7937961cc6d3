#include "lab/techniques/structure_technique.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/host_structure.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kRecordCode[] =
#include "cursor_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "cursor_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "cursor_log.comp.inc"
    ;

std::unique_ptr<Producer> make_producer(const StructureOptions& options) {
    return options.producer == ProducerKind::paper ? make_paper_producer(options) : make_library_producer(options);
}

template <typename Work>
double milliseconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

TechniqueInfo structure_technique_info(const char* name, const char* summary, StructureKind kind) {
    TechniqueInfo info;
    info.name = name;
    info.summary = summary;
    info.options = structure_option_infos(kind);
    return info;
}

std::uint64_t BuiltStructure::bytes() const {
    return std::accumulate(buffers.begin(), buffers.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const gpu::Buffer* buffer) { return sum + buffer->bytes(); });
}

QueryShaders cursor_shaders() { return {kRecordCode, kShadeCode, kLogCode}; }

StructureTechnique::StructureTechnique(gpu::Device& device, TechniqueInfo info, StructureKind kind,
                                       const OptionValues& values, const QueryShaders& shaders)
    : device_(device), info_(std::move(info)), producer_(make_producer(read_structure_options(info_, kind, values))),
      buffers_(device),
      pass_(device,
            {info_.name, shaders.record, shaders.shade, shaders.log, 5, shaders.constants, shaders.log_has_wave_size},
            LightSplit::none) {}

void StructureTechnique::prepare(const Frame& frame) {
    lights_.emplace(device_, frame);
    stats_ = {};
    rebuild(frame);
    stats_.visible_lights = producer_->stats().visible_lights;
    stats_.references = structure_.references;
    stats_.structure_bytes = structure_.bytes();
}

// The time is the producer's alone: the lab's own allocation and its patterns are left out.
void StructureTechnique::rebuild(const Frame& frame) {
    ManylightsSizes sizes{};
    const double plan_ms = milliseconds_of([&] { sizes = producer_->plan(frame); });
    buffers_.reserve(sizes);
    const double write_ms = milliseconds_of([&] { producer_->write(buffers_.targets()); });
    buffers_.finish();
    add_times(plan_ms, write_ms);
    structure_ = refine(frame, {buffers_.bindings(), producer_->stats().references});
}

void StructureTechnique::add_times(double plan_ms, double write_ms) {
    stats_.build_ms.push_back(plan_ms + write_ms);
    std::vector<StageTime> stages = producer_->stages();
    if (stages.empty()) stages.push_back({"plan", plan_ms});
    stages.push_back({"write", write_ms});
    for (const StageTime& stage : stages) add_stage(stage.name, stage.ms);
}

void StructureTechnique::add_stage(const std::string& name, double ms) {
    auto stage = std::ranges::find(stats_.stages, name, &NamedTimes::name);
    if (stage == stats_.stages.end()) stage = stats_.stages.insert(stage, {name, {}});
    stage->ms.push_back(ms);
}

std::vector<PixelRecord> StructureTechnique::record(const Frame& frame) {
    return pass_.record(frame, lights_.value(), one_band(frame, structure_.buffers));
}

std::vector<float> StructureTechnique::shade(const Frame& frame) {
    return pass_.shade(frame, lights_.value(), one_band(frame, structure_.buffers), stats_.shade_ms);
}

WaveSummary StructureTechnique::waves(const Frame& frame) {
    return pass_.waves(frame, lights_.value(), one_band(frame, structure_.buffers));
}

std::optional<double> StructureTechnique::references_in_range(const Frame& frame) {
    const HostStructure structure(structure_.buffers);
    if (structure.view.structure != ML_STRUCTURE_WINDOWS) return std::nullopt;
    return mean_references_in_range(structure, frame.points.download_positions());
}

std::vector<CellClass> StructureTechnique::classify(const Frame& frame) {
    return classify_tiles(HostStructure(structure_.buffers), frame.points.download_positions());
}

// The reference becomes one to the padding light behind the last, which affects nothing.
bool StructureTechnique::remove_one_reference(const Frame& frame) {
    const LightStream& lights = lights_.value().stream;
    const auto reference =
        find_affecting_reference(HostStructure(structure_.buffers), frame.points.download_positions(), lights);
    const std::uint32_t padding = lights.light_count();
    if (reference) structure_.buffers[4]->upload(std::span(&padding, 1), *reference * sizeof padding);
    return reference.has_value();
}

} // namespace manylights::lab
