#include "lab/app/work_table.h"

#include "lab/app/number_scale.h"
#include "lab/app/text_table.h"

#include <fmt/format.h>

namespace manylights::lab::app {
namespace {

std::string options_text(const OptionValues& options) {
    std::string text;
    for (const auto& [key, value] : options) text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
    return text.empty() ? "defaults" : text;
}

std::vector<std::string> figures(const suites::Measurement& m) {
    return {m.technique,
            options_text(m.options),
            with_separators(m.work.shaded),
            with_separators(m.stats.visible_lights),
            fmt::format("{:.1f}", m.work.tested_mean),
            with_separators(m.work.tested_p95),
            fmt::format("{:.2f}", m.work.affecting_mean),
            with_separators(m.stats.references),
            fmt::format("{:.1f}", static_cast<double>(m.stats.structure_bytes) / 1024.0),
            m.stats.build_ms.empty() ? "-" : fmt::format("{:.2f}", suites::median(m.stats.build_ms))};
}

} // namespace

std::string work_table(const std::vector<suites::Measurement>& measurements, const std::vector<std::string>& verdicts) {
    using enum Align;
    std::vector<TextTable::Column> columns = {{"technique", left},       {"options", left},     {"points", right},
                                              {"visible lights", right}, {"tested/px", right},  {"p95", right},
                                              {"affecting", right},      {"references", right}, {"KiB", right},
                                              {"build ms", right}};
    if (!verdicts.empty()) {
        columns.push_back({"missing points", right});
        columns.push_back({"verdict", left});
    }
    TextTable table(columns);
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        std::vector<std::string> row = figures(measurements[i]);
        if (!verdicts.empty()) {
            row.push_back(with_separators(measurements[i].missing_points.value_or(0)));
            row.push_back(verdicts.at(i));
        }
        table.add(std::move(row));
    }
    return table.str();
}

} // namespace manylights::lab::app
