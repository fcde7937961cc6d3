#include "lab/suites/quality.h"
#include "lab/suites/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace manylights::lab::suites {
namespace {

/// The rows of one technique with the same options in one scene with one number of lights, over several views.
using Rows = std::vector<const Row*>;

/// Rows of one scene and one number of lights, by label in the order of their first rows.
struct Group {
    std::string title;
    std::vector<std::pair<std::string, Rows>> cameras, path;
};

bool is_right(const Row& row) { return row.at("missing_points") == 0; }

// The grid first, as in 32x64: tiles of 32 pixels, 64 slices. Then words by themselves, and numbers with their keys.
std::string option_words(const Row& options) {
    std::vector<std::string> words;
    if (options.contains("tile_size")) words.push_back(options.at("tile_size"));
    if (options.contains("tile_size") && options.contains("slice_count"))
        words[0] += fmt::format("x{}", options.at("slice_count").get<std::string>());
    for (const auto& [key, value] : options.items()) {
        if (options.contains("tile_size") && (key == "tile_size" || key == "slice_count")) continue;
        const std::string text = value.get<std::string>();
        const bool is_word = std::isalpha(static_cast<unsigned char>(text.front())) != 0;
        words.push_back(is_word ? text : fmt::format("{}={}", key, text));
    }
    return fmt::format("{}", fmt::join(words, " "));
}

/// What a row is called: its technique, with the options where rows of the technique differ in them.
class Labels {
  public:
    explicit Labels(std::span<const Row> rows) {
        for (const Row& row : rows) options_[row.at("technique")].insert(row.at("options").dump());
    }
    std::string of(const Row& row) const {
        const std::string technique = row.at("technique");
        return options_.at(technique).size() > 1 ? fmt::format("{} {}", technique, option_words(row.at("options")))
                                                 : technique;
    }

  private:
    std::map<std::string, std::set<std::string>> options_;
};

void add_row(std::vector<std::pair<std::string, Rows>>& techniques, const std::string& label, const Row& row) {
    auto found =
        std::find_if(techniques.begin(), techniques.end(), [&](const auto& entry) { return entry.first == label; });
    if (found == techniques.end()) found = techniques.insert(techniques.end(), {label, {}});
    found->second.push_back(&row);
}

std::vector<Group> groups_of(std::span<const Row> rows) {
    std::vector<Group> groups;
    const Labels labels(rows);
    for (const Row& row : rows) {
        const std::string title = fmt::format(
            "{}, {} lights ({}), {}x{}", row.at("scene").get<std::string>(), row.at("lights").get<std::uint64_t>(),
            row.at("distribution").get<std::string>(), row.at("width").get<int>(), row.at("height").get<int>());
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.title == title; });
        if (group == groups.end()) group = groups.insert(groups.end(), {title, {}, {}});
        const bool on_path = row.at("camera").get<std::string>().starts_with("path:");
        add_row(on_path ? group->path : group->cameras, labels.of(row), row);
    }
    return groups;
}

double value(const Row& row, const char* key) { return row.at(key).is_null() ? 0.0 : row.at(key).get<double>(); }

double mean(const Rows& rows, const char* key) {
    double sum = 0.0;
    for (const Row* row : rows) sum += value(*row, key);
    return sum / static_cast<double>(rows.size());
}

std::string ratio(double a, double b) { return b > 0.0 ? fmt::format("{:.2f}", a / b) : "-"; }
std::string number(double a) { return fmt::format("{:.1f}", a); }

bool all_right(const Rows& rows) {
    return std::all_of(rows.begin(), rows.end(), [](const Row* row) { return is_right(*row); });
}

// Ratios are of the means over the views, so that a view in which hardly any light affects a point does not decide.
Table work_table(const Group& group) {
    Table table(fmt::format("{}, mean of {} cameras", group.title, group.cameras.front().second.size()),
                {"technique", "tested / affecting", "tested / px", "p95", "nodes / px", "compared / in range",
                 "references", "KiB", "wave 64", "wave 32", "wave 64, b c / 2", "b c x 2", "wave 64 p99",
                 "union tested / union affecting"});
    for (const auto& [name, rows] : group.cameras) {
        if (!all_right(rows)) {
            table.add({name, "WRONG"});
            continue;
        }
        table.add({name, ratio(mean(rows, "tested_mean"), mean(rows, "affecting_mean")),
                   number(mean(rows, "tested_mean")), number(mean(rows, "tested_p95")),
                   number(mean(rows, "nodes_mean")),
                   ratio(mean(rows, "references_mean"), mean(rows, "references_in_range_mean")),
                   fmt::format("{:.0f}", mean(rows, "references")),
                   fmt::format("{:.0f}", mean(rows, "structure_bytes") / 1024.0), number(mean(rows, "wave_cost_64")),
                   number(mean(rows, "wave_cost_32")), number(mean(rows, "wave_cost_64_half")),
                   number(mean(rows, "wave_cost_64_double")), number(mean(rows, "wave_cost_64_p99")),
                   ratio(mean(rows, "wave_tested_64"), mean(rows, "wave_affecting_64"))});
    }
    return table;
}

/// Modelled cost per frame of the path.
std::vector<double> costs(const Rows& rows) {
    std::vector<double> result;
    for (const Row* row : rows) result.push_back(value(*row, "wave_cost_64"));
    return result;
}

std::vector<double> costs_of(const Group& group, const std::string& technique) {
    for (const auto& [label, rows] : group.path)
        if (rows.front()->at("technique") == technique && all_right(rows)) return costs(rows);
    return {};
}

std::string worst_over_exact(const std::vector<double>& cost, const std::vector<double>& exact) {
    double worst = 0.0;
    for (std::size_t i = 0; i < std::min(cost.size(), exact.size()); ++i)
        if (exact[i] > 0.0) worst = std::max(worst, cost[i] / exact[i]);
    return worst > 0.0 ? fmt::format("{:.2f}", worst) : "-";
}

Table path_table(const Group& group) {
    Table table(fmt::format("{}, wave cost (64 lanes) over {} frames of the path", group.title,
                            group.path.front().second.size()),
                {"technique", "best frame", "mean", "worst frame", "worst / best", "worst frame: hybrid / this",
                 "worst over exact", "tested / affecting"});
    const std::vector<double> exact = costs_of(group, "exact"), hybrid = costs_of(group, "hybrid_light_trees");
    for (const auto& [name, rows] : group.path) {
        if (!all_right(rows)) {
            table.add({name, "WRONG"});
            continue;
        }
        const std::vector<double> cost = costs(rows);
        const auto [best, worst] = std::minmax_element(cost.begin(), cost.end());
        table.add({name, number(*best), number(mean(rows, "wave_cost_64")), number(*worst), ratio(*worst, *best),
                   hybrid.empty() ? "-" : ratio(*std::max_element(hybrid.begin(), hybrid.end()), *worst),
                   worst_over_exact(cost, exact), ratio(mean(rows, "tested_mean"), mean(rows, "affecting_mean"))});
    }
    return table;
}

// Lowest minimum, mean of the medians, highest maximum over the views.
std::string spread(const Rows& rows, const char* key, const char* format) {
    double least = 0.0, most = 0.0, sum = 0.0;
    std::size_t count = 0;
    for (const Row* row : rows) {
        const Row& times = row->at(key);
        if (times.at("min").is_null()) continue;
        least = count == 0 ? times.at("min").get<double>() : std::min(least, times.at("min").get<double>());
        most = std::max(most, times.at("max").get<double>());
        sum += times.at("median").get<double>();
        ++count;
    }
    if (count == 0) return "-";
    const auto text = [format](double v) { return fmt::format(fmt::runtime(format), v); };
    return fmt::format("{} ({} to {})", text(sum / static_cast<double>(count)), text(least), text(most));
}

Table times_table(const Group& group) {
    Table table(fmt::format("{}: times, mean of the cameras' medians (least to most of all rounds)", group.title),
                {"technique", "shade / exact", "shade ms", "build ms, warm", "build ms, cold"});
    for (const auto& [name, rows] : group.cameras) {
        if (!all_right(rows) || rows.front()->at("shade_ms").at("min").is_null()) continue;
        table.add({name, spread(rows, "shade_over_exact", "{:.2f}"), spread(rows, "shade_ms", "{:.0f}"),
                   spread(rows, "build_ms", "{:.1f}"), spread(rows, "cold_build_ms", "{:.1f}")});
    }
    return table;
}

} // namespace

std::string quality_tables(std::span<const Row> rows) {
    std::vector<std::string> texts;
    const auto add = [&texts](const Table& table) {
        if (!table.empty()) texts.push_back(table.markdown());
    };
    for (const Group& group : groups_of(rows)) {
        if (!group.cameras.empty()) add(work_table(group));
        if (!group.path.empty()) add(path_table(group));
        if (!group.cameras.empty()) add(times_table(group));
    }
    return fmt::format("{}", fmt::join(texts, "\n"));
}

} // namespace manylights::lab::suites
