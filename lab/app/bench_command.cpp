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
#include "lab/suites/journal.h"
#include "lab/suites/suite.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

namespace manylights::lab::app {
namespace {

using suites::Row;
using suites::Step;
using suites::StepResult;

std::string file_name(const BenchArguments& arguments, const char* ending) {
    return (std::filesystem::path(arguments.out) / (arguments.suite + ending)).string();
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!std::filesystem::is_directory(path, error))
        throw InputError(fmt::format("--out '{}': is no folder and cannot be made one", path));
}

struct Outcome {
    std::vector<Row> rows;
    std::vector<std::string> failures;

    void add(const StepResult& result) {
        rows.insert(rows.end(), result.rows.begin(), result.rows.end());
        failures.insert(failures.end(), result.failures.begin(), result.failures.end());
    }
};

Outcome run_steps(const std::vector<Step>& steps, suites::Journal& journal, suites::RunContext context) {
    RemainingTime remaining;
    for (const Step& step : steps)
        if (journal.find(step.id) == nullptr) remaining.expect(step.weight);
    Progress progress;
    std::string now;
    context.say = [&](const std::string& what) { progress.at(now + what); };
    Outcome outcome;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Step& step = steps[i];
        now = fmt::format("{}/{}, {} left: {}: ", i + 1, steps.size(), remaining.text(), step.label);
        if (journal.find(step.id) == nullptr) {
            journal.add(step.id, step.run(context));
            remaining.done(step.weight);
        }
        outcome.add(*journal.find(step.id));
    }
    return outcome;
}

std::string report_text(const suites::Suite& suite, const Row& conditions, const suites::StepList& list,
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

void write_files(const BenchArguments& arguments, const suites::Suite& suite, const Row& conditions,
                 const Outcome& outcome, const std::string& report) {
    write_text(file_name(arguments, ".json"), json_text(conditions, outcome.rows));
    write_text(file_name(arguments, ".csv"), suites::csv_text(outcome.rows, suite.columns()));
    write_text(file_name(arguments, ".md"), report);
}

} // namespace

int run_bench(const BenchArguments& arguments) {
    const suites::Suite& suite = suites::find_suite(arguments.suite);
    const suites::StepList list = suite.steps(arguments.options);
    std::optional<gpu::Device> device;
    if (suite.needs_device) device.emplace(gpu::DeviceOptions{arguments.device, arguments.validation});
    make_folder(arguments.out);
    const Row conditions = suites::conditions_of(suite.name, device ? &device->info() : nullptr);
    suites::Journal journal(file_name(arguments, ".journal"), conditions, suite.columns(), arguments.resume);
    for (const std::string& line : list.skipped) fmt::print(stderr, "manylights: {}\n", line);
    const Outcome outcome =
        run_steps(list.steps, journal, {device ? &*device : nullptr, {}, arguments.remove_one_light});
    const std::string report = report_text(suite, conditions, list, outcome);
    write_files(arguments, suite, conditions, outcome, report);
    fmt::print("{}", report);
    for (const std::string& failure : outcome.failures) fmt::print(stderr, "manylights: {}\n", failure);
    const int checked = outcome.failures.empty() ? kDone : kCheckFailed;
    return device ? std::max(checked, report_validation(*device)) : checked;
}

} // namespace manylights::lab::app
