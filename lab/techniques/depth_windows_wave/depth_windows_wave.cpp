#include "lab/techniques/depth_windows_wave/depth_windows_wave.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSubgroupRecordCode[] =
#include "wave_subgroup_record.comp.inc"
    ;
constexpr std::uint32_t kSubgroupShadeCode[] =
#include "wave_subgroup_shade.comp.inc"
    ;
constexpr std::uint32_t kEmulatedRecordCode[] =
#include "wave_emulated_record.comp.inc"
    ;
constexpr std::uint32_t kEmulatedShadeCode[] =
#include "wave_emulated_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "wave_emulated_log.comp.inc"
    ;

constexpr const char* kWaves[] = {"subgroup", "4", "8", "16", "32", "64"};

// What a wave of so many lanes touches is counted with emulated waves of that size, whatever the device's own are.
QueryShaders shaders_of(gpu::Device& device, const OptionValues& options) {
    const std::size_t wave = OptionReader(depth_windows_wave_info(), options).choice("wave", kWaves);
    if (wave != 0) return {kEmulatedRecordCode, kEmulatedShadeCode, kLogCode, {2u << wave}, true};
    if (!device.info().has_wave_operations)
        throw DeviceError("depth_windows_wave: option wave=subgroup: " + device.info().name +
                          " has no ballots and reductions in compute shaders; wave=32 does without");
    return {kSubgroupRecordCode, kSubgroupShadeCode, kLogCode, {}, true};
}

} // namespace

TechniqueInfo depth_windows_wave_info() {
    TechniqueInfo info = structure_technique_info(
        "depth_windows_wave", "depth_windows, with candidates tested by a wave against what all of its points cover",
        StructureKind::windows);
    info.options.push_back(
        {"wave", "lanes of a wave", "subgroup (default): the device's own; 4, 8, 16, 32, 64: emulated"});
    return info;
}

std::unique_ptr<Technique> make_depth_windows_wave(gpu::Device& device, const OptionValues& options) {
    const TechniqueInfo info = depth_windows_wave_info();
    return std::make_unique<StructureTechnique>(
        device, info, read_structure_options(info, StructureKind::windows, options), shaders_of(device, options));
}

} // namespace manylights::lab
