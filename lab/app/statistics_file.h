#pragma once
// The file of --stats: a row per technique.

#include "lab/suites/row.h"

#include <string>
#include <vector>

namespace manylights::lab::app {

/// One row is written as an object, several as an array of them. Throws InputError naming the path.
void write_statistics(const std::string& path, const std::vector<suites::Row>& rows);

} // namespace manylights::lab::app
