#pragma once
// Numbers of a legend: round tops, round ticks, and figures that people read at a glance.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace manylights::lab::app {

/// The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten that is not below value; at least 1.
double round_up_nicely(double value);

/// 0, step, 2 step, ... up to top, with step 1, 2 or 5 times a power of ten, and at most `most` steps.
std::vector<double> tick_values(double top, int most);

/// The value that the given share of the values does not exceed: nearest rank. 0 of nothing.
double percentile(std::span<const float> values, double share);

std::string with_separators(std::uint64_t value); ///< 65536 -> "65,536"
std::string short_number(double value);           ///< at most three significant digits behind the point: 12.3, 0.412

} // namespace manylights::lab::app
