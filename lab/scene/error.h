#pragma once
// The two ways in which the lab gives up, each one line: what, where, the rule. The command maps them to its exit
// codes.

#include <stdexcept>
#include <string>

namespace manylights::lab {

/// Bad usage or bad input: exit code 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// No usable device, or a device that gave up: exit code 3.
struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace manylights::lab
