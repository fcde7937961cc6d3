#include "lab/techniques/device/depth_order.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kKeysCode[] =
#include "depth_keys.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64, kSortedBits = 32;

} // namespace

DepthOrder::DepthOrder(gpu::Device& device, bool by_near_end)
    : sort_(device), keys_pipeline_(device, {"depths of lights", kKeysCode, 3, sizeof(std::uint32_t), {by_near_end}}),
      keys_(device, "depths of lights"), order_(device, "lights in view by depth") {}

void DepthOrder::reserve(std::uint32_t lights) {
    for (FittedBuffer* buffer : {&keys_, &order_}) buffer->fit(std::uint64_t{lights} * sizeof(std::uint32_t));
    sort_.reserve(lights);
}

void DepthOrder::record(gpu::Commands& commands, const VisibleLights& lights, bool sorts) {
    const std::uint32_t count = lights.count();
    if (count == 0) return;
    commands.dispatch(keys_pipeline_, {{lights.lights()}, {keys_.buffer()}, {order_.buffer()}}, count,
                      {gpu::group_count(count, kGroupSize), 1, 1});
    if (sorts)
        sort_.record(commands, keys_.buffer(), order_.buffer(), count, kSortedBits);
    else
        commands.barrier();
}

} // namespace manylights::lab
