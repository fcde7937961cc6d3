#include "lab/app/commands.h"
#include "lab/app/image_check.h"
#include "lab/app/progress.h"
#include "lab/app/statistics_file.h"
#include "lab/app/validation_report.h"
#include "lab/app/verify_truth.h"
#include "lab/app/work_table.h"
#include "lab/app/workbench.h"
#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/verification.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace manylights::lab::app {
namespace {

struct Verdict {
    suites::Measurement measurement;
    VerifyResult result;
    std::string image; ///< what is wrong with the shaded image; empty: nothing
    bool right() const { return result.exact() && image.empty(); }
};

void damage(Technique& technique, const Frame& frame) {
    if (!technique.remove_one_reference(frame))
        throw InputError(
            fmt::format("--remove-one-light '{}': there is no reference to remove", technique.info().name));
}

Verdict judge(Workbench& bench, Technique& technique, const std::vector<PixelRecord>& records, const Truth& truth,
              const VerifyArguments& arguments) {
    const Frame& frame = bench.frame();
    const std::string& name = technique.info().name;
    const std::vector<float> radiance = technique.shade(frame);
    Verdict verdict;
    verdict.result = compare(truth.records, records, frame.width);
    verdict.image = image_difference(truth.radiance, radiance, truth.mask, frame.width, frame.height);
    suites::Measurement& m = verdict.measurement;
    m.technique = name;
    m.options = bench.options_for(name);
    m.work = summarize(records);
    m.stats = technique.stats();
    m.light_set_hash = light_set_hash(records);
    m.missing_points = verdict.result.missing_points;
    m.wrong = !verdict.result.exact();
    if (!arguments.stats.empty()) {
        m.waves = technique.waves(frame);
        m.references_in_range = technique.references_in_range(frame);
    }
    return verdict;
}

Verdict judge(Workbench& bench, const std::string& name, const Truth& truth, const VerifyArguments& arguments,
              Progress& progress) {
    progress.at(fmt::format("{}: building and shading", name));
    const bool remove_one = name == arguments.remove_one_light;
    // What the truth took is not computed twice; its image is still checked against its records.
    if (name == truth.shader->info().name && !remove_one)
        return judge(bench, *truth.shader, truth.shaded, truth, arguments);
    const std::unique_ptr<Technique> technique = bench.make_prepared(name, kTimedBuilds);
    if (remove_one) damage(*technique, bench.frame());
    return judge(bench, *technique, technique->record(bench.frame()), truth, arguments);
}

std::string verdict_text(const Verdict& verdict) {
    if (verdict.right()) return "exact";
    return verdict.result.exact() ? "WRONG IMAGE" : "WRONG";
}

std::string table_of(const std::vector<Verdict>& verdicts) {
    std::vector<suites::Measurement> measurements;
    std::vector<std::string> texts;
    for (const Verdict& verdict : verdicts) {
        measurements.push_back(verdict.measurement);
        texts.push_back(verdict_text(verdict));
    }
    return work_table(measurements, texts);
}

// Which lights, where the hashes tell: one or two that are missing.
std::string lost_lights(const VerifyResult& result, const Workbench& bench) {
    const std::size_t pixel = std::size_t{result.first_y} * bench.frame().width + result.first_x;
    const glm::vec3 point = bench.frame().points.download_positions().at(pixel).position;
    const std::vector<std::uint32_t> affecting = affecting_lights(make_light_stream(bench.frame()), point);
    const std::vector<std::uint32_t> lost = missing_lights(result.first_truth, result.first_got, affecting);
    if (lost.empty()) return "";
    return fmt::format(", missing light{} {}", lost.size() > 1 ? "s" : "", fmt::join(lost, " and "));
}

std::string failure(const Verdict& verdict, const Truth& truth, const Workbench& bench) {
    const std::string& name = verdict.measurement.technique;
    if (verdict.result.exact()) return fmt::format("{}: shaded image: {}", name, verdict.image);
    const VerifyResult& result = verdict.result;
    return fmt::format("{}: {} of {} points differ from {}; first at pixel ({}, {}): {} of {} affecting lights{}", name,
                       result.wrong_pixels, result.pixels, truth.name, result.first_x, result.first_y,
                       result.first_got.affecting, result.first_truth.affecting, lost_lights(result, bench));
}

void write_rows(const std::vector<Verdict>& verdicts, Workbench& bench, const VerifyArguments& arguments) {
    if (arguments.stats.empty()) return;
    std::vector<suites::Row> rows;
    for (const Verdict& verdict : verdicts)
        rows.push_back(make_row(bench.row_view(), bench.device().info(), verdict.measurement));
    write_statistics(arguments.stats, rows);
}

std::vector<Verdict> judge_all(Workbench& bench, const VerifyArguments& arguments, const Truth& truth,
                               Progress& progress) {
    std::vector<Verdict> verdicts;
    for (const std::string& name : truth.techniques) verdicts.push_back(judge(bench, name, truth, arguments, progress));
    return verdicts;
}

int report(const std::vector<Verdict>& verdicts, const Truth& truth, const Workbench& bench) {
    fmt::print("{}\n{}\n{}", bench.description(), truth.description, table_of(verdicts));
    int code = kDone;
    for (const Verdict& verdict : verdicts) {
        if (verdict.right()) continue;
        fmt::print(stderr, "manylights: {}\n", failure(verdict, truth, bench));
        code = kCheckFailed;
    }
    return code;
}

} // namespace

int run_verify(const VerifyArguments& arguments) {
    if (!arguments.stats.empty()) check_writable(arguments.stats);
    Workbench bench(arguments.selectors);
    Progress progress;
    const Truth truth = find_truth(bench, arguments, progress);
    if (!truth.failure.empty()) {
        progress.clear();
        fmt::print(stderr, "manylights: {}\n", truth.failure);
        return kCheckFailed;
    }
    const std::vector<Verdict> verdicts = judge_all(bench, arguments, truth, progress);
    progress.clear();
    const int code = report(verdicts, truth, bench);
    write_rows(verdicts, bench, arguments);
    return std::max(code, report_validation(bench.device()));
}

} // namespace manylights::lab::app
