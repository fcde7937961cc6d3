#pragma once
// Rows as comma-separated values, for spreadsheets.

#include "lab/suites/schema.h"

namespace manylights::lab::suites {

/// A line of titles, and one per row. Times become KEY_min, KEY_median, KEY_max and KEY_repeats; objects KEY=VALUE
/// pairs (stages: of their medians); what was not measured is empty.
std::string csv_text(std::span<const Row> rows, std::span<const Column> columns);

} // namespace manylights::lab::suites
