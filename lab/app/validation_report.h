#pragma once
// What the validation layers said.

#include "lab/gpu/device.h"

namespace manylights::lab::app {

/// Prints a line where validation is active; kCheckFailed when there were messages, else kDone.
int report_validation(const gpu::Device& device);

} // namespace manylights::lab::app
