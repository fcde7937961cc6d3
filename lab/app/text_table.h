#pragma once
// A table of text with aligned columns, for terminals.

#include <string>
#include <vector>

namespace manylights::lab::app {

enum class Align { left, right };

class TextTable {
  public:
    struct Column {
        std::string title;
        Align align;
    };
    explicit TextTable(std::vector<Column> columns);

    void add(std::vector<std::string> row);
    /// Title line and one line per row, two blanks between columns, no blanks at line ends. Without titles: rows only.
    std::string str(bool with_titles = true) const;

  private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

} // namespace manylights::lab::app
