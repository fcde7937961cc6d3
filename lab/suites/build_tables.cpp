#include "lab/suites/build.h"
#include "lab/suites/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

namespace manylights::lab::suites {
namespace {

/// The rows of one scene: a table has its builders below each other, and its numbers of lights side by side.
struct Group {
    std::string title;
    std::vector<const Row*> rows;
    std::vector<std::string> builders;
    std::set<std::uint64_t> lights;

    const Row* find(const std::string& builder, std::uint64_t count) const;
};

std::string builder_of(const Row& row) {
    const auto threads = row.at("threads").get<std::uint64_t>();
    return row.at("builder").get<std::string>() + (threads > 1 ? fmt::format(", {} threads", threads) : "");
}

const Row* Group::find(const std::string& builder, std::uint64_t count) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row* row) {
        return builder_of(*row) == builder && row->at("lights") == count;
    });
    return found == rows.end() ? nullptr : *found;
}

std::vector<Group> groups_of(std::span<const Row> rows) {
    std::vector<Group> groups;
    for (const Row& row : rows) {
        const std::string title =
            fmt::format("{} ({}), {}x{}", row.at("scene").get<std::string>(), row.at("distribution").get<std::string>(),
                        row.at("width").get<int>(), row.at("height").get<int>());
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.title == title; });
        if (group == groups.end()) group = groups.insert(groups.end(), {title, {}, {}, {}});
        group->rows.push_back(&row);
        group->lights.insert(row.at("lights").get<std::uint64_t>());
        if (std::find(group->builders.begin(), group->builders.end(), builder_of(row)) == group->builders.end())
            group->builders.push_back(builder_of(row));
    }
    return groups;
}

/// Empty where there is nothing to say.
using Cell = std::function<std::string(const Group&, const Row&)>;

Table table_of(const Group& group, const std::string& title, const Cell& cell) {
    std::vector<std::string> columns{"builder"};
    for (const std::uint64_t count : group.lights) columns.push_back(fmt::format("{} lights", count));
    Table table(fmt::format("{}: {}", group.title, title), columns);
    for (const std::string& builder : group.builders) {
        std::vector<std::string> cells{builder};
        for (const std::uint64_t count : group.lights) {
            const Row* row = group.find(builder, count);
            cells.push_back(row != nullptr ? cell(group, *row) : "");
        }
        const bool is_empty =
            std::all_of(cells.begin() + 1, cells.end(), [](const auto& text) { return text.empty(); });
        if (!is_empty) table.add(cells);
    }
    return table;
}

// Median (least to most of the rounds).
Cell times_cell(const char* key, const char* digits) {
    return [=](const Group&, const Row& row) {
        const Row& times = row.at(key);
        if (times.at("median").is_null()) return std::string();
        const auto text = [&](const char* member) {
            return fmt::format(fmt::runtime(digits), times.at(member).get<double>());
        };
        return fmt::format("{} ({} to {})", text("median"), text("min"), text("max"));
    };
}

// What few lights cost of what 65,536 cost.
std::string share_cell(const Group& group, const Row& row) {
    const Row* many = group.find(builder_of(row), 65536);
    if (many == nullptr || row.at("lights") >= 65536) return "";
    const double of = many->at("build_ms").at("median").get<double>();
    return of > 0.0 ? fmt::format("{:.3f}", row.at("build_ms").at("median").get<double>() / of) : "";
}

std::string size_cell(const Group&, const Row& row) {
    return fmt::format("{}, {} KiB, {} px", row.at("references").get<std::uint64_t>(),
                       row.at("structure_bytes").get<std::uint64_t>() / 1024, row.at("tile_px").get<int>());
}

} // namespace

std::string build_tables(std::span<const Row> rows) {
    std::vector<std::string> texts;
    const auto add = [&](const Group& group, const std::string& title, const Cell& cell) {
        const Table table = table_of(group, title, cell);
        if (!table.empty()) texts.push_back(table.markdown());
    };
    for (const Group& group : groups_of(rows)) {
        add(group, "paper's pipeline over this, warm", times_cell("paper_over_this", "{:.2f}"));
        add(group, "paper's pipeline over this, cold", times_cell("paper_over_this_cold", "{:.2f}"));
        add(group, "one thread over two", times_cell("one_thread_over_this", "{:.2f}"));
        add(group, "this over the floor of the machine", times_cell("this_over_floor", "{:.2f}"));
        add(group, "build ms, warm", times_cell("build_ms", "{:.3f}"));
        add(group, "of the build of 65,536 lights", share_cell);
        add(group, "references, bytes, tiles", size_cell);
    }
    return fmt::format("{}", fmt::join(texts, "\n"));
}

} // namespace manylights::lab::suites
