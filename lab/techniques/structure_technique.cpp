#include "lab/techniques/structure_technique.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/device_build/device_build.h"
#include "lab/techniques/host_structure.h"
#include "lab/techniques/light_records.h"

#include <algorithm>

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

constexpr std::uint32_t kWalkRecordCode[] =
#include "tree_walk_record.comp.inc"
    ;
constexpr std::uint32_t kWalkShadeCode[] =
#include "tree_walk_shade.comp.inc"
    ;
constexpr std::uint32_t kWalkLogCode[] =
#include "tree_walk_log.comp.inc"
    ;

// 16 KiB of a workgroup's memory, of which Vulkan promises as much.
constexpr std::uint32_t kCopiedNodes = 1024;

std::unique_ptr<StructureBuild> make_build(gpu::Device& device, const std::string& name,
                                           const StructureOptions& options) {
    return options.on_device ? make_device_build(device, name, options) : make_host_build(device, options);
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

QueryShaders tree_shaders(const StructureOptions& options) {
    if (!options.needs_tree_walk()) return cursor_shaders();
    return {kWalkRecordCode,
            kWalkShadeCode,
            kWalkLogCode,
            {options.has_three_paths, options.copies_trees ? kCopiedNodes : 1, options.has_records}};
}

StructureTechnique::StructureTechnique(gpu::Device& device, TechniqueInfo info, StructureKind kind,
                                       const OptionValues& values)
    : StructureTechnique(device, info, read_structure_options(info, kind, values)) {}

StructureTechnique::StructureTechnique(gpu::Device& device, TechniqueInfo info, const StructureOptions& options)
    : StructureTechnique(device, std::move(info), options, tree_shaders(options)) {}

StructureTechnique::StructureTechnique(gpu::Device& device, TechniqueInfo info, const StructureOptions& options,
                                       const QueryShaders& shaders)
    : device_(device), info_(std::move(info)), has_records_(options.has_records),
      build_(make_build(device, info_.name, options)),
      pass_(device,
            {info_.name, shaders.record, shaders.shade, shaders.log, 5, shaders.constants, shaders.log_has_wave_size},
            LightSplit::none) {}

void StructureTechnique::prepare(const Frame& frame) {
    lights_.emplace(device_, frame);
    stats_ = {};
    rebuild(frame);
    stats_.visible_lights = build_->visible_lights();
    stats_.references = structure_.references;
    stats_.structure_bytes = structure_.bytes();
}

void StructureTechnique::rebuild(const Frame& frame) {
    const BuiltStructure built = build_->build(frame, lights_.value());
    stats_.build_ms.push_back(build_->milliseconds());
    for (const StageTime& stage : build_->stages()) add_stage(stage.name, stage.ms);
    structure_ = refine(frame, built);
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
    return classify_tiles(HostStructure(structure_.buffers, has_records_), frame.points.download_positions());
}

// The reference becomes one to the padding light behind the last, which affects nothing.
bool StructureTechnique::remove_one_reference(const Frame& frame) {
    const LightStream& lights = lights_.value().stream;
    const auto reference = find_affecting_reference(HostStructure(structure_.buffers, has_records_),
                                                    frame.points.download_positions(), lights);
    if (!reference) return false;
    const std::uint32_t padding = lights.light_count();
    gpu::Buffer& references = *structure_.buffers[4];
    if (has_records_) {
        const LightRecord record = light_record(lights, padding);
        references.upload(std::span(&record, 1), *reference * sizeof record);
    } else {
        references.upload(std::span(&padding, 1), *reference * sizeof padding);
    }
    return true;
}

} // namespace manylights::lab
