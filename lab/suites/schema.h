#pragma once
// The columns of rows, in order: what kind of value each holds, and whether it may be missing.

#include "lab/suites/row.h"

namespace manylights::lab::suites {

enum class ColumnKind {
    text,
    texts,  ///< an object of texts
    whole,  ///< a whole number, not negative
    number, ///< finite, not negative
    times,  ///< {"min", "median", "max", "repeats"}: numbers in order; null and 0 repeats where nothing was measured
    stages, ///< an object of times
    hash,   ///< 16 hexadecimal digits
};

struct Column {
    const char* key;
    ColumnKind kind;
    bool may_be_null; ///< where nothing was measured; times and stages have their own way of saying so

    Row empty_value() const;
};

/// Of what techniques do in a view (make_row). Suites that measure something else have columns of their own.
std::span<const Column> schema();

/// The times of what was not measured.
Row no_times();

/// Those of what was.
Row times_of(const std::vector<double>& values);

/// What is wrong with a row, by key and rule; empty: nothing.
std::string row_fault(const Row& row, std::span<const Column> columns);

} // namespace manylights::lab::suites
