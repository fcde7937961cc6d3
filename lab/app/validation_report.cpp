#include "lab/app/validation_report.h"

#include "lab/app/commands.h"

#include <fmt/format.h>

namespace manylights::lab::app {

int report_validation(const gpu::Device& device) {
    if (!device.validation_active()) return kDone;
    fmt::print("validation: core and synchronization active, {} messages ({})\n", device.validation_messages(),
               device.validation_layer());
    return device.validation_messages() == 0 ? kDone : kCheckFailed;
}

} // namespace manylights::lab::app
