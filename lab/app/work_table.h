#pragma once
// The table that render and verify print: a line of figures per technique.

#include "lab/suites/row.h"

#include <string>
#include <vector>

namespace manylights::lab::app {

/// verdicts: empty, or one per measurement; then the missing points are shown as well.
std::string work_table(const std::vector<suites::Measurement>& measurements, const std::vector<std::string>& verdicts);

} // namespace manylights::lab::app
