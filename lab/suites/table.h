#pragma once
// A table that reads well both in a terminal and as Markdown.

#include <string>
#include <vector>

namespace manylights::lab::suites {

class Table {
  public:
    /// The first column is aligned to the left, the others to the right.
    Table(std::string title, std::vector<std::string> columns);

    void add(std::vector<std::string> row);
    bool empty() const { return rows_.empty(); }
    /// "### title", and the table with padded columns.
    std::string markdown() const;

  private:
    std::string title_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

} // namespace manylights::lab::suites
