#pragma once
// Does the device compute right? Two faults of real drivers would make wrong pictures silently.

namespace manylights::lab::gpu {

class Device;

/// Throws DeviceError that names the device and what to do, where
/// - a shader's loops end after 65,535 iterations together, or
/// - a memory barrier in divergent control flow acts as an execution barrier.
void probe_behaviour(Device& device);

} // namespace manylights::lab::gpu
