#pragma once

namespace manylights::lab {

/// The standard normal distribution cut at -2 and 2, from u uniform in [0, 1): inverse of its distribution function.
/// Mean 0, variance 0.7737.
double truncated_normal(double u);

} // namespace manylights::lab
