#include "lab/suites/journal.h"

#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace manylights::lab::suites {
namespace {

std::string read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

} // namespace

Journal::Journal(std::string path, const Row& header, std::span<const Column> columns, bool resume)
    : path_(std::move(path)), columns_(columns) {
    if (resume && std::filesystem::exists(path_))
        read(header);
    else
        write_text(path_, header.dump() + "\n");
}

void Journal::refuse(const std::string& why) const { throw InputError(fmt::format("--resume '{}': {}", path_, why)); }

void Journal::read(const Row& header) {
    std::string text = read_whole(path_);
    const std::size_t complete = text.rfind('\n') + 1; // 0 where there is none: npos + 1
    if (complete != text.size()) std::filesystem::resize_file(path_, complete);
    text.resize(complete);
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line)) refuse("is empty; start without --resume");
    const Row found = Row::parse(line, nullptr, false);
    for (const auto& [key, value] : header.items())
        if (!found.is_object() || found.value(key, Row()) != value)
            refuse(fmt::format("{} is {}, must be {}: rows of different runs are not mixed", key,
                               found.is_object() ? found.value(key, Row()).dump() : "missing", value.dump()));
    for (std::size_t number = 2; std::getline(lines, line); ++number) read_line(line, number);
}

void Journal::read_line(const std::string& line, std::size_t number) {
    const auto check = [&](bool holds, const std::string& rule) {
        if (!holds) refuse(fmt::format("line {}: {}; start without --resume", number, rule));
    };
    const Row entry = Row::parse(line, nullptr, false);
    check(entry.is_object() && entry.contains("case") && entry["case"].is_string(), "must hold a case");
    check(entry.contains("rows") && entry["rows"].is_array(), "must hold rows");
    check(entry.contains("failures") && entry["failures"].is_array(), "must hold failures");
    StepResult result;
    for (const Row& row : entry["rows"]) {
        check(row_fault(row, columns_).empty(), row_fault(row, columns_));
        result.rows.push_back(row);
    }
    for (const Row& failure : entry["failures"]) {
        check(failure.is_string(), "failures must be texts");
        result.failures.push_back(failure);
    }
    results_[entry["case"]] = std::move(result);
}

const StepResult* Journal::find(const std::string& id) const {
    const auto found = results_.find(id);
    return found == results_.end() ? nullptr : &found->second;
}

void Journal::add(const std::string& id, const StepResult& result) {
    append({{"case", id}, {"rows", result.rows}, {"failures", result.failures}});
    results_[id] = result;
}

void Journal::append(const Row& line) {
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    file << line.dump() << '\n';
    file.close();
    if (!file) cannot_write(path_, "the disk may be full");
}

} // namespace manylights::lab::suites
