#include "lab/app/remaining_time.h"

#include <fmt/format.h>

namespace manylights::lab::app {

std::string RemainingTime::text(double seconds_so_far) const {
    if (done_ <= 0.0) return "?";
    const double seconds = seconds_so_far / done_ * (expected_ - done_);
    return seconds < 90.0 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60.0);
}

} // namespace manylights::lab::app
