#include "lab/app/statistics_file.h"

#include "lab/renderer/unfinished_file.h"

namespace manylights::lab::app {

void write_statistics(const std::string& path, const std::vector<suites::Row>& rows) {
    const std::string text = (rows.size() == 1 ? rows[0] : suites::Row(rows)).dump(2) + "\n";
    write_text(path, text);
}

} // namespace manylights::lab::app
