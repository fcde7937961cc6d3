#include "lab/suites/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace manylights::lab::suites {
namespace {

using enum ColumnKind;

constexpr Column kColumns[] = {
    {"technique", text, false},
    {"options", texts, false},
    {"scene", text, false},
    {"distribution", text, false},
    {"lights", whole, false},
    {"seed", whole, false},
    {"camera", text, false},
    {"width", whole, false},
    {"height", whole, false},
    {"device", text, false},
    {"driver", text, false},
    {"visible_lights", whole, true},
    {"points", whole, true},
    {"tested_mean", number, true},
    {"tested_p95", whole, true},
    {"tested_max", whole, true},
    {"affecting_mean", number, true},
    {"nodes_mean", number, true},
    {"references_mean", number, true},
    {"references_in_range_mean", number, true},
    {"wave_cost_64", number, true},
    {"wave_cost_32", number, true},
    {"wave_cost_64_half", number, true},
    {"wave_cost_64_double", number, true},
    {"wave_cost_64_p99", number, true},
    {"wave_tested_64", number, true},
    {"wave_tested_32", number, true},
    {"wave_affecting_64", number, true},
    {"wave_affecting_32", number, true},
    {"wave_nodes_64", number, true},
    {"wave_checks_64", number, true},
    {"references", whole, true},
    {"structure_bytes", whole, true},
    {"build_ms", times, false},
    {"cold_build_ms", times, false},
    {"stages_ms", stages, false},
    {"shade_ms", times, false},
    {"shade_over_exact", times, false},
    {"light_set_hash", hash, true},
    {"missing_points", whole, true},
};

bool is_number(const Row& value) {
    return value.is_number() && std::isfinite(value.get<double>()) && value.get<double>() >= 0.0;
}

bool is_times(const Row& value) {
    if (!value.is_object() || value.size() != 4) return false;
    for (const char* key : {"min", "median", "max", "repeats"})
        if (!value.contains(key)) return false;
    if (value["repeats"] == 0) return value == no_times();
    return value["repeats"].is_number_unsigned() && is_number(value["min"]) && is_number(value["median"]) &&
           is_number(value["max"]) && value["min"] <= value["median"] && value["median"] <= value["max"];
}

bool is_hash(const Row& value) {
    return value.is_string() && value.get<std::string>().size() == 16 &&
           value.get<std::string>().find_first_not_of("0123456789abcdef") == std::string::npos;
}

template <typename Check>
bool all_of_object(const Row& value, Check check) {
    return value.is_object() && std::all_of(value.begin(), value.end(), check);
}

bool fits(ColumnKind kind, const Row& value) {
    switch (kind) {
    case text:
        return value.is_string();
    case texts:
        return all_of_object(value, [](const Row& member) { return member.is_string(); });
    case whole:
        return value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
    case number:
        return is_number(value);
    case times:
        return is_times(value);
    case stages:
        return all_of_object(value, is_times);
    case hash:
        return is_hash(value);
    }
    return false;
}

const char* rule(ColumnKind kind) {
    switch (kind) {
    case text:
        return "a text";
    case texts:
        return "an object of texts";
    case whole:
        return "a whole number, not negative";
    case number:
        return "a finite number, not negative";
    case times:
        return "an object of min <= median <= max and repeats";
    case stages:
        return "an object of times";
    case hash:
        return "16 hexadecimal digits";
    }
    return "";
}

} // namespace

Row Column::empty_value() const {
    if (kind == times) return no_times();
    return kind == stages ? Row::object() : Row(nullptr);
}

std::span<const Column> schema() { return kColumns; }

Row no_times() { return {{"min", nullptr}, {"median", nullptr}, {"max", nullptr}, {"repeats", 0}}; }

Row times_of(const std::vector<double>& values) {
    if (values.empty()) return no_times();
    return {{"min", *std::min_element(values.begin(), values.end())},
            {"median", median(values)},
            {"max", *std::max_element(values.begin(), values.end())},
            {"repeats", values.size()}};
}

std::string row_fault(const Row& row, std::span<const Column> columns) {
    if (!row.is_object()) return "must be an object";
    for (const Column& column : columns) {
        if (!row.contains(column.key)) return fmt::format("{}: is missing", column.key);
        const Row& value = row[column.key];
        if (value.is_null() && column.may_be_null) continue;
        if (!fits(column.kind, value))
            return fmt::format("{}: is {}, must be {}", column.key, value.dump(), rule(column.kind));
    }
    if (row.size() == columns.size()) return "";
    for (const auto& item : row.items())
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const Column& column) { return column.key == item.key(); }))
            return fmt::format("{}: is no column of the schema", item.key());
    return "";
}

} // namespace manylights::lab::suites
