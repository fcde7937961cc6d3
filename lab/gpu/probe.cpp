#include "lab/gpu/probe.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <string>

namespace manylights::lab::gpu {

namespace {

constexpr std::uint32_t kLoopCode[] =
#include "probe_loop.comp.inc"
    ;
constexpr std::uint32_t kBarrierCode[] =
#include "probe_barrier.comp.inc"
    ;

std::vector<std::uint32_t> run(Device& device, const ComputeShader& shader, std::uint32_t push, std::uint32_t count) {
    const ComputePipeline pipeline(device, shader);
    const Buffer result(device, "probe", count * sizeof(std::uint32_t), Memory::readback);
    Commands commands(device);
    commands.fill(result, 0xDEADBEEFu);
    commands.barrier();
    commands.dispatch(pipeline, {{result}}, push, {1, 1, 1});
    commands.submit_and_wait("the behaviour probe");
    return result.download<std::uint32_t>();
}

// More than the budget of the faulty drivers, which all loops of an invocation share.
bool loops_complete(Device& device) {
    constexpr std::uint32_t kIterations = 70000;
    constexpr std::uint32_t kInvocations = 8;
    const auto result = run(device, {"probe_loop", kLoopCode, 1, 4, {}}, kIterations, kInvocations);
    for (std::uint32_t i = 0; i < kInvocations; ++i) {
        std::uint32_t state = i;
        for (std::uint32_t k = 0; k < kIterations; ++k) state = state * 1664525u + 1013904223u;
        for (std::uint32_t k = 0; k < kIterations; ++k) state = state * 22695477u + 1u;
        if (result[i] != state) return false;
    }
    return true;
}

bool memory_barriers_do_not_execute(Device& device) {
    constexpr std::uint32_t kInvocations = 128;
    constexpr std::uint32_t kFirstDivergent = 112;
    const auto result = run(device, {"probe_barrier", kBarrierCode, 1, 4, {}}, kFirstDivergent, kInvocations);
    for (std::uint32_t i = 0; i < kInvocations; ++i)
        if (result[i] != (i + 64) % kInvocations + 1) return false;
    return true;
}

} // namespace

void probe_behaviour(Device& device) {
    const bool loops = loops_complete(device);
    const bool barriers = memory_barriers_do_not_execute(device);
    if (loops && barriers) return;
    std::string faults = loops ? "" : "its loops end after 65,535 iterations";
    if (!barriers) faults += std::string(loops ? "" : " and ") + "its memory barriers act as execution barriers";
    throw DeviceError("the device " + device.info().name + " (" + device.info().version +
                      ") computes wrong: " + faults + "; run scripts/setup for a driver that does not");
}

} // namespace manylights::lab::gpu
