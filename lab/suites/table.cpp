#include "lab/suites/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::suites {

Table::Table(std::string title, std::vector<std::string> columns)
    : title_(std::move(title)), columns_(std::move(columns)) {}

void Table::add(std::vector<std::string> row) {
    row.resize(columns_.size());
    rows_.push_back(std::move(row));
}

std::string Table::markdown() const {
    std::vector<std::size_t> widths(columns_.size(), 3);
    const auto widen = [&](const std::vector<std::string>& row) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    };
    widen(columns_);
    for (const auto& row : rows_) widen(row);

    std::string text = fmt::format("### {}\n\n", title_);
    const auto add_line = [&](const std::vector<std::string>& row) {
        for (std::size_t i = 0; i < row.size(); ++i)
            text += i == 0 ? fmt::format("| {:<{}} |", row[i], widths[i]) : fmt::format(" {:>{}} |", row[i], widths[i]);
        text += "\n";
    };
    add_line(columns_);
    for (std::size_t i = 0; i < widths.size(); ++i)
        text += i == 0 ? fmt::format("|:{:-<{}}-|", "", widths[i]) : fmt::format("-{:-<{}}:|", "", widths[i]);
    text += "\n";
    for (const auto& row : rows_) add_line(row);
    return text;
}

} // namespace manylights::lab::suites
