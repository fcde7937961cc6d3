#include "lab/app/commands.h"
#include "lab/app/number_scale.h"
#include "lab/app/progress.h"
#include "lab/app/remaining_time.h"
#include "lab/app/validation_report.h"
#include "lab/gpu/device.h"
#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"
#include "lab/suites/conditions.h"
#include "lab/suites/csv.h"
#include "lab/suites/runner.h"
#include "lab/suites/suite.h"

#include <fmt/format.h>

#include <filesystem>

namespace manylights::lab::app {
namespace {

using suites::Case;
using suites::CaseResult;
using suites::Row;

std::string file_name(const BenchArguments& arguments, const char* ending) {
    return (std::filesystem::path(arguments.out) / (arguments.suite + ending)).string();
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!std::filesystem::is_directory(path, error))
        throw InputError(fmt::format("--out '{}': is no folder and cannot be made one", path));
}

/// What a case takes, in units that are about equal: a fixed share, and the lights' share.
double weight(const Case& c) { return 1.0 + static_cast<double>(c.lights.count) / 262144.0; }

struct Outcome {
    std::vector<Row> rows;
    std::vector<std::string> failures;

    void add(const CaseResult& result) {
        rows.insert(rows.end(), result.rows.begin(), result.rows.end());
        failures.insert(failures.end(), result.failures.begin(), result.failures.end());
    }
};

Outcome run_cases(const std::vector<Case>& cases, suites::Journal& journal, gpu::Device& device,
                  const std::string& damaged) {
    RemainingTime remaining;
    for (const Case& c : cases)
        if (journal.find(case_id(c)) == nullptr) remaining.expect(weight(c));
    Progress progress;
    std::string now;
    suites::Runner runner(device, {[&](const std::string& what) { progress.at(now + what); }, damaged});
    Outcome outcome;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::string id = case_id(cases[i]);
        now = fmt::format("{}/{}, {} left: {}: ", i + 1, cases.size(), remaining.text(), case_label(cases[i]));
        if (journal.find(id) == nullptr) {
            journal.add(id, runner.run(cases[i]));
            remaining.done(weight(cases[i]));
        }
        outcome.add(*journal.find(id));
    }
    return outcome;
}

std::string report_text(const suites::Suite& suite, const Row& conditions, const suites::CaseList& list,
                        const Outcome& outcome) {
    std::string text =
        fmt::format("## {}\n\n{}\n\n{}\n", suite.name, suite.summary, suites::conditions_text(conditions));
    for (const std::string& line : list.skipped) text += line + "\n";
    return text + "\n" + suite.tables(outcome.rows);
}

// A line per row, so that files of two runs compare line by line.
std::string json_text(const Row& conditions, const std::vector<Row>& rows) {
    std::string text = fmt::format("{{\"conditions\": {},\n\"rows\": [", conditions.dump());
    for (const Row& row : rows) text += fmt::format("{}\n{}", &row == rows.data() ? "" : ",", row.dump());
    return text + "\n]}\n";
}

void write_files(const BenchArguments& arguments, const Row& conditions, const Outcome& outcome,
                 const std::string& report) {
    write_text(file_name(arguments, ".json"), json_text(conditions, outcome.rows));
    write_text(file_name(arguments, ".csv"), suites::csv_text(outcome.rows));
    write_text(file_name(arguments, ".md"), report);
}

} // namespace

int run_bench(const BenchArguments& arguments) {
    const suites::Suite& suite = suites::find_suite(arguments.suite);
    const suites::CaseList list = suite.cases(arguments.options);
    gpu::Device device({arguments.device, arguments.validation});
    make_folder(arguments.out);
    const Row conditions = suites::conditions_of(suite.name, device.info());
    suites::Journal journal(file_name(arguments, ".journal"), conditions, arguments.resume);
    for (const std::string& line : list.skipped) fmt::print(stderr, "manylights: {}\n", line);
    const Outcome outcome = run_cases(list.cases, journal, device, arguments.remove_one_light);
    const std::string report = report_text(suite, conditions, list, outcome);
    write_files(arguments, conditions, outcome, report);
    fmt::print("{}", report);
    for (const std::string& failure : outcome.failures) fmt::print(stderr, "manylights: {}\n", failure);
    return std::max(outcome.failures.empty() ? kDone : kCheckFailed, report_validation(device));
}

} // namespace manylights::lab::app
