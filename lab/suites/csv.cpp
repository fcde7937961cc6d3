#include "lab/suites/csv.h"

#include <fmt/format.h>

namespace manylights::lab::suites {
namespace {

constexpr const char* kTimes[] = {"min", "median", "max", "repeats"};

// Quoted where it needs to be (RFC 4180).
std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
    std::string text = "\"";
    for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

std::string plain(const Row& value) {
    if (value.is_null()) return "";
    return quoted(value.is_string() ? value.get<std::string>() : value.dump());
}

// KEY=VALUE pairs, of the median where a member is a time.
std::string pairs(const Row& object) {
    std::vector<std::string> texts;
    for (const auto& [key, value] : object.items())
        texts.push_back(fmt::format("{}={}", key, plain(value.is_object() ? value["median"] : value)));
    return quoted(fmt::format("{}", fmt::join(texts, " ")));
}

void add_cells(std::vector<std::string>& cells, const Column& column, const Row& value) {
    if (column.kind == ColumnKind::times)
        for (const char* key : kTimes) cells.push_back(plain(value[key]));
    else
        cells.push_back(value.is_object() ? pairs(value) : plain(value));
}

void add_titles(std::vector<std::string>& cells, const Column& column) {
    if (column.kind == ColumnKind::times)
        for (const char* key : kTimes) cells.push_back(fmt::format("{}_{}", column.key, key));
    else
        cells.emplace_back(column.key);
}

std::string line_of(const std::vector<std::string>& cells) { return fmt::format("{}\n", fmt::join(cells, ",")); }

} // namespace

std::string csv_text(std::span<const Row> rows, std::span<const Column> columns) {
    std::vector<std::string> cells;
    for (const Column& column : columns) add_titles(cells, column);
    std::string text = line_of(cells);
    for (const Row& row : rows) {
        cells.clear();
        for (const Column& column : columns) add_cells(cells, column, row.at(column.key));
        text += line_of(cells);
    }
    return text;
}

} // namespace manylights::lab::suites
