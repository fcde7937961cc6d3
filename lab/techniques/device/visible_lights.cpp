#include "lab/techniques/device/visible_lights.h"

#include "lab/gpu/device.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kMarkCode[] =
#include "visible_lights_mark.comp.inc"
    ;
constexpr std::uint32_t kWriteCode[] =
#include "visible_lights_write.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64;

struct Push {
    DeviceView view;
    std::uint32_t light_count;
};

} // namespace

VisibleLights::VisibleLights(gpu::Device& device)
    : device_(device), prefix_sum_(device),
      mark_pipeline_(device, {"lights in view, marks", kMarkCode, 2, sizeof(Push), {}}),
      write_pipeline_(device, {"lights in view", kWriteCode, 3, sizeof(Push), {}}), marks_(device, "marks of lights"),
      places_(device, "places of lights"), total_(device, "lights in view, their number"),
      lights_(device, "lights in view") {}

// One mark more than there are lights, 0: its place is the number of all.
double VisibleLights::find(const DeviceView& view, const gpu::Buffer& spheres, std::uint32_t light_count) {
    const std::uint64_t words = std::uint64_t{light_count} + 1;
    marks_.fit(words * sizeof(std::uint32_t));
    places_.fit(words * sizeof(std::uint32_t));
    total_.fit(sizeof(std::uint32_t));
    lights_.fit(std::uint64_t{light_count} * sizeof(VisibleLight));
    prefix_sum_.reserve(static_cast<std::uint32_t>(words));

    const Push push{view, light_count};
    const std::array<std::uint32_t, 3> groups{gpu::group_count(light_count, kGroupSize), 1, 1};
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(marks_.buffer(), 0);
    commands.barrier();
    if (light_count != 0) commands.dispatch(mark_pipeline_, {{spheres}, {marks_.buffer()}}, push, groups);
    prefix_sum_.record(commands, marks_.buffer(), places_.buffer(), static_cast<std::uint32_t>(words), total_.buffer());
    if (light_count != 0)
        commands.dispatch(write_pipeline_, {{spheres}, {places_.buffer()}, {lights_.buffer()}}, push, groups);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("lights in view");
    count_ = total_.buffer().download<std::uint32_t>(1).front();
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
