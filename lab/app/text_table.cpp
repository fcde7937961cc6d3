#include "lab/app/text_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::app {

TextTable::TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

void TextTable::add(std::vector<std::string> row) {
    row.resize(columns_.size());
    rows_.push_back(std::move(row));
}

std::string TextTable::str(bool with_titles) const {
    std::vector<std::vector<std::string>> lines;
    if (with_titles) {
        lines.emplace_back();
        for (const Column& column : columns_) lines.back().push_back(column.title);
    }
    lines.insert(lines.end(), rows_.begin(), rows_.end());

    std::vector<std::size_t> widths(columns_.size(), 0);
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());

    std::string text;
    for (const auto& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i > 0) text += "  ";
            text += columns_[i].align == Align::left ? fmt::format("{:<{}}", line[i], widths[i])
                                                     : fmt::format("{:>{}}", line[i], widths[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

} // namespace manylights::lab::app
