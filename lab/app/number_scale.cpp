#include "lab/app/number_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace manylights::lab::app {
namespace {

double power_of_ten_below(double value) {
    double power = 1.0;
    while (power * 10.0 <= value) power *= 10.0;
    while (power > value) power /= 10.0;
    return power;
}

} // namespace

double round_up_nicely(double value) {
    if (!(value > 1.0)) return 1.0;
    const double power = power_of_ten_below(value);
    for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (factor * power >= value) return factor * power;
    return 10.0 * power;
}

std::vector<double> tick_values(double top, int most) {
    if (!(top > 0.0) || !std::isfinite(top)) return {0.0};
    const double least_step = top / std::max(most, 1);
    const double power = power_of_ten_below(least_step);
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= least_step) step = factor * power;
    std::vector<double> ticks;
    for (int i = 0; i * step <= top * (1.0 + 1e-9); ++i) ticks.push_back(i * step);
    return ticks;
}

double percentile(std::span<const float> values, double share) {
    if (values.empty()) return 0.0;
    std::vector<float> sorted(values.begin(), values.end());
    const auto count = static_cast<double>(sorted.size());
    const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(share * count), 1.0, count));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1), sorted.end());
    return static_cast<double>(sorted[rank - 1]);
}

std::string with_separators(std::uint64_t value) {
    std::string digits = std::to_string(value);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), 1, ',');
    return digits;
}

std::string short_number(double value) {
    if (value >= 1000.0) return with_separators(static_cast<std::uint64_t>(std::llround(value)));
    if (value >= 100.0 || value == std::floor(value)) return fmt::format("{:.0f}", value);
    return value >= 10.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.2f}", value);
}

} // namespace manylights::lab::app
