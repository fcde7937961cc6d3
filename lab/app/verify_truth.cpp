#include "lab/app/verify_truth.h"

#include "lab/app/image_check.h"
#include "lab/app/number_scale.h"
#include "lab/scene/error.h"
#include "lab/techniques/truth.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::app {
namespace {

constexpr const char* kBruteForce = "brute_force";

bool is_too_long(const Frame& frame) {
    return std::uint64_t{frame.width} * frame.height * frame.lights.size() > kMostTests;
}

// Radiance is compared within one device: with the grid, that of the technique which shades just the grid's lights.
const char* radiance_technique(bool by_grid) { return by_grid ? "exact" : kBruteForce; }

std::string left_out() {
    return fmt::format("\nleft out: {}, which takes more than {} tests of a light at a pixel", kBruteForce,
                       with_separators(kMostTests));
}

void find_sets_by_grid(Truth& truth, const Frame& frame, bool damaged, Progress& progress) {
    progress.at("grid oracle: finding the lights of every point");
    const std::vector<PointPosition> positions = frame.points.download_positions();
    PointLists lists = find_point_lists(frame, positions);
    if (damaged && !remove_one_light(lists, positions))
        throw InputError(fmt::format("--remove-one-light '{}': there is no light to remove", kGridOracle));
    progress.at("grid oracle: testing every light at some of the points");
    const ListCheck check = check_lists(frame, lists, positions);
    if (check.first_wrong)
        truth.failure = fmt::format("grid oracle: differs from {} at pixel ({}, {}), first of {} points checked",
                                    kBruteForce, *check.first_wrong % frame.width, *check.first_wrong / frame.width,
                                    with_separators(check.points));
    truth.name = "the grid oracle";
    truth.description =
        fmt::format("truth: grid oracle, itself equal to {} at {} of {} points", kBruteForce,
                    with_separators(check.points), with_separators(std::ranges::count(truth.mask, std::uint8_t{1})));
    truth.records = light_set_records(frame, lists, positions, frame.points.download_normals());
}

void take_radiance(Truth& truth, Workbench& bench, bool by_grid, Progress& progress) {
    const std::string name = radiance_technique(by_grid);
    progress.at(by_grid ? fmt::format("{}: building and shading", name)
                        : fmt::format("{}: testing every light at every pixel", name));
    truth.shader = bench.make_prepared(name, by_grid ? kTimedBuilds : 1);
    truth.shaded = truth.shader->record(bench.frame());
    truth.radiance = radiance_of(truth.shaded);
}

void find_by_grid(Truth& truth, Workbench& bench, bool damaged, Progress& progress) {
    find_sets_by_grid(truth, bench.frame(), damaged, progress);
    if (!truth.failure.empty()) return;
    take_radiance(truth, bench, true, progress);
    for (std::size_t i = 0; i < truth.records.size(); ++i)
        std::ranges::copy(truth.shaded[i].radiance, truth.records[i].radiance);
    truth.description += fmt::format("; radiance: {}", truth.shader->info().name);
}

void find_by_brute_force(Truth& truth, Workbench& bench, bool damaged, Progress& progress) {
    if (damaged) throw InputError(fmt::format("--remove-one-light '{}': the truth is {}", kGridOracle, kBruteForce));
    take_radiance(truth, bench, false, progress);
    truth.records = truth.shaded;
    truth.name = kBruteForce;
    truth.description = fmt::format("truth: {} at all {} points", kBruteForce,
                                    with_separators(std::ranges::count(truth.mask, std::uint8_t{1})));
}

} // namespace

Truth find_truth(Workbench& bench, const VerifyArguments& arguments, Progress& progress) {
    const bool too_long = is_too_long(bench.frame());
    const bool by_grid = arguments.truth == TruthKind::grid || (arguments.truth == TruthKind::automatic && too_long);
    const bool damaged = arguments.remove_one_light == kGridOracle;
    Truth truth;
    truth.mask = bench.shaded_mask();
    truth.techniques = arguments.techniques;
    const bool leaves_out = by_grid && too_long && arguments.all_techniques;
    if (leaves_out) std::erase(truth.techniques, kBruteForce);
    if (by_grid)
        find_by_grid(truth, bench, damaged, progress);
    else
        find_by_brute_force(truth, bench, damaged, progress);
    if (leaves_out) truth.description += left_out();
    return truth;
}

} // namespace manylights::lab::app
