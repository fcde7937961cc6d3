#pragma once
// What all rows of a run have in common and a reader of its figures must know.

#include "lab/suites/row.h"

namespace manylights::lab::suites {

/// suite, version, device and driver where one is used, processor, cores, compiler. The same on every run of the same
/// build on the same machine.
Row conditions_of(const std::string& suite, const gpu::DeviceInfo* device);

/// In one line.
std::string conditions_text(const Row& conditions);

} // namespace manylights::lab::suites
