#include "lab/techniques/clustered_samples/light_hierarchy.h"

#include "lab/gpu/device.h"
#include "lab/techniques/device/spread.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kExtentCode[] =
#include "hierarchy_extent.comp.inc"
    ;
constexpr std::uint32_t kCodesCode[] =
#include "hierarchy_codes.comp.inc"
    ;
constexpr std::uint32_t kLeavesCode[] =
#include "hierarchy_leaves.comp.inc"
    ;
constexpr std::uint32_t kLevelCode[] =
#include "hierarchy_level.comp.inc"
    ;

constexpr std::uint32_t kCodeBits = 30, kLightGroup = 256, kNodeGroup = 64;
constexpr std::uint64_t kWord = sizeof(std::uint32_t), kSphereBytes = 16, kBoxBytes = 32;
// Fan-outs of 8 reach 2^26 lights, the most that are sorted, with 9 levels.
constexpr std::uint32_t kMaxLevels = 12;

/// The text of hierarchy.glsl.
struct HierarchyShape {
    DeviceView view;
    std::uint32_t fan_out, level_count, unused[2];
    std::array<std::array<std::uint32_t, 2>, kMaxLevels> levels;
};
static_assert(sizeof(HierarchyShape) == 176);

// Of the lights, then of each level above, until one workgroup's lanes are enough for the highest.
std::vector<std::uint32_t> sizes_of_levels(std::uint32_t lights, std::uint32_t fan_out) {
    std::vector<std::uint32_t> sizes{lights};
    while (sizes.back() > fan_out) sizes.push_back(gpu::group_count(sizes.back(), fan_out));
    return sizes;
}

} // namespace

LightHierarchy::LightHierarchy(gpu::Device& device, std::uint32_t fan_out)
    : device_(device), fan_out_(fan_out), visible_(device), sort_(device),
      extent_pipeline_(device, {"light hierarchy, extent", kExtentCode, 2, kWord, {}}),
      codes_pipeline_(device, {"light hierarchy, codes", kCodesCode, 4, kWord, {}}),
      leaves_pipeline_(device, {"light hierarchy, leaves", kLeavesCode, 4, kWord, {}}),
      level_pipeline_(device, {"light hierarchy, level", kLevelCode, 3, kWord, {}}),
      shape_(device, "shape of the light hierarchy"), nodes_(device, "nodes of the light hierarchy"),
      spheres_(device, "spheres of the light hierarchy"), indices_(device, "lights of the light hierarchy"),
      extent_(device, "extent of the lights"), codes_(device, "Morton codes"), places_(device, "places of lights") {}

double LightHierarchy::build(const DeviceView& view, const gpu::Buffer& spheres, std::uint32_t light_count) {
    const double visible_ms = visible_.find(view, spheres, light_count);
    fit(view);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    if (visible_.count() != 0) sort(commands);
    for (std::uint32_t level = 1; level < level_sizes_.size(); ++level) {
        commands.barrier();
        commands.dispatch(level_pipeline_, {{shape()}, {this->spheres()}, {nodes()}}, level,
                          spread_groups(gpu::group_count(level_sizes_[level], kNodeGroup)));
    }
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("the light hierarchy");
    return visible_ms + commands.milliseconds(start, end);
}

void LightHierarchy::fit(const DeviceView& view) {
    level_sizes_ = sizes_of_levels(visible_.count(), fan_out_);
    HierarchyShape shape{view, fan_out_, static_cast<std::uint32_t>(level_sizes_.size()), {}, {}};
    shape.levels[0] = {0, visible_.count()};
    std::uint32_t nodes = 0;
    for (std::size_t level = 1; level < level_sizes_.size(); ++level) {
        shape.levels.at(level) = {nodes, level_sizes_[level]};
        nodes += level_sizes_[level];
    }
    shape_.fit(sizeof(HierarchyShape));
    shape_.buffer().upload(std::span<const HierarchyShape>(&shape, 1));
    nodes_.fit(kBoxBytes * nodes);
    spheres_.fit(kSphereBytes * visible_.count());
    indices_.fit(kWord * visible_.count());
    extent_.fit(6 * kWord);
    codes_.fit(kWord * visible_.count());
    places_.fit(kWord * visible_.count());
    sort_.reserve(visible_.count());
}

void LightHierarchy::sort(gpu::Commands& commands) {
    const gpu::Buffer &lights = visible_.lights(), &extent = extent_.buffer(), &codes = codes_.buffer(),
                      &places = places_.buffer();
    const std::uint32_t count = visible_.count();
    const std::array<std::uint32_t, 3> groups = spread_groups(gpu::group_count(count, kLightGroup));
    commands.fill(extent, 0);
    commands.barrier();
    commands.dispatch(extent_pipeline_, {{lights}, {extent}}, count, groups);
    commands.barrier();
    commands.dispatch(codes_pipeline_, {{lights}, {extent}, {codes}, {places}}, count, groups);
    sort_.record(commands, codes, places, count, kCodeBits);
    commands.dispatch(leaves_pipeline_, {{lights}, {places}, {spheres()}, {indices()}}, count, groups);
}

} // namespace manylights::lab
