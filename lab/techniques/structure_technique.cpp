#include "lab/techniques/structure_technique.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/host_structure.h"

#include <chrono>

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
    const ProducerStats built = producer_->stats();
    stats_.visible_lights = built.visible_lights;
    stats_.references = built.references;
    stats_.structure_bytes = buffers_.bytes();
}

// The time is the producer's alone: the lab's own allocation and its patterns are left out.
void StructureTechnique::rebuild(const Frame& frame) {
    ManylightsSizes sizes{};
    const double plan_ms = milliseconds_of([&] { sizes = producer_->plan(frame); });
    buffers_.reserve(sizes);
    const double write_ms = milliseconds_of([&] { producer_->write(buffers_.targets()); });
    buffers_.finish();
    add_times(plan_ms, write_ms);
}

void StructureTechnique::add_times(double plan_ms, double write_ms) {
    stats_.build_ms.push_back(plan_ms + write_ms);
    std::vector<StageTime> stages = producer_->stages();
    if (stages.empty()) stages.push_back({"plan", plan_ms});
    stages.push_back({"write", write_ms});
    stats_.stages.resize(stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i) {
        stats_.stages[i].name = stages[i].name;
        stats_.stages[i].ms.push_back(stages[i].ms);
    }
}

std::vector<PixelRecord> StructureTechnique::record(const Frame& frame) {
    return pass_.record(frame, lights_.value(), one_band(frame, buffers_.bindings()));
}

std::vector<float> StructureTechnique::shade(const Frame& frame) {
    return pass_.shade(frame, lights_.value(), one_band(frame, buffers_.bindings()), stats_.shade_ms);
}

WaveSummary StructureTechnique::waves(const Frame& frame) {
    return pass_.waves(frame, lights_.value(), one_band(frame, buffers_.bindings()));
}

std::vector<CellClass> StructureTechnique::classify(const Frame& frame) {
    return classify_tiles(HostStructure(buffers_), frame.points.download_positions());
}

// The reference becomes one to the padding light behind the last, which affects nothing.
bool StructureTechnique::remove_one_reference(const Frame& frame) {
    const LightStream& lights = lights_.value().stream;
    const auto reference = find_affecting_reference(HostStructure(buffers_), frame.points.download_positions(), lights);
    if (reference) buffers_.overwrite_reference(*reference, lights.light_count());
    return reference.has_value();
}

} // namespace manylights::lab
