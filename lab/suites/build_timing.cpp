#include "lab/suites/build_timing.h"

#include "lab/suites/build.h"
#include "lab/suites/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace manylights::lab::suites {
namespace {

using enum ColumnKind;

constexpr Column kColumns[] = {
    {"builder", text, false},
    {"threads", whole, false},
    {"tile_px", whole, false},
    {"scene", text, false},
    {"distribution", text, false},
    {"lights", whole, false},
    {"seed", whole, false},
    {"width", whole, false},
    {"height", whole, false},
    {"visible_lights", whole, false},
    {"references", whole, false},
    {"structure_bytes", whole, false},
    {"build_ms", times, false},
    {"cold_build_ms", times, false},
    {"paper_over_this", times, false},
    {"paper_over_this_cold", times, false},
    {"this_over_floor", times, false},
    {"one_thread_over_this", times, false},
};

struct Timed {
    BuilderChoice choice;
    std::unique_ptr<Contender> contender;
    std::vector<double> warm, cold; ///< milliseconds, one per round; of a block: its median
};

constexpr std::uint32_t kNoStructure = 0;           // of the library
constexpr std::string_view kFloorOf = "windows 48"; // whose references the floor writes

std::vector<BuilderChoice> library_choices() {
    std::vector<BuilderChoice> choices;
    const BuilderChoice one_thread[] = {
        {"hybrid 48", MANYLIGHTS_STRUCTURE_HYBRID, 48, 1},   {"trees 48", MANYLIGHTS_STRUCTURE_TREES, 48, 1},
        {"lists 48", MANYLIGHTS_STRUCTURE_LISTS, 48, 1},     {"windows 48", MANYLIGHTS_STRUCTURE_WINDOWS, 48, 1},
        {"windows 32", MANYLIGHTS_STRUCTURE_WINDOWS, 32, 1}, {"windows chosen", MANYLIGHTS_STRUCTURE_WINDOWS, 0, 1}};
    for (const BuilderChoice& choice : one_thread) {
        choices.push_back(choice);
        if (has_threads()) choices.push_back({choice.name, choice.structure, choice.tile_px, 2});
    }
    return choices;
}

// Each has built once: its memory is there. The paper's comes first, the floor last.
std::vector<Timed> make_builders(const BuildFrame& frame) {
    std::vector<Timed> builders;
    builders.push_back({{"paper hybrid 48", kNoStructure, 48, 1}, make_paper_contender(), {}, {}});
    for (const BuilderChoice& choice : library_choices())
        builders.push_back({choice, make_library_contender(choice), {}, {}});
    BuildCounts of_floor;
    for (Timed& timed : builders) {
        timed.contender->build(frame);
        if (timed.choice.name == kFloorOf) of_floor = timed.contender->counts();
    }
    builders.push_back({{"floor", kNoStructure, 48, 1}, make_floor_contender(of_floor), {}, {}});
    builders.back().contender->build(frame);
    return builders;
}

// By the clock on the wall: two threads work at the same time.
double build_ms(Timed& timed, const BuildFrame& frame) {
    const auto begin = std::chrono::steady_clock::now();
    timed.contender->build(frame);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double block_ms(Timed& timed, const BuildFrame& frame, std::uint32_t builds) {
    std::vector<double> ms;
    for (std::uint32_t i = 0; i < builds; ++i) ms.push_back(build_ms(timed, frame));
    return median(ms);
}

// The order turns by one from round to round.
void run_rounds(std::vector<Timed>& builders, const BuildFrame& frame, const BuildRounds& rounds) {
    std::vector<std::uint32_t> sweep(kSweepBytes / sizeof(std::uint32_t));
    for (std::uint32_t round = 0; round < rounds.blocks; ++round) {
        for (std::size_t i = 0; i < builders.size(); ++i) {
            Timed& timed = builders[(round + i) % builders.size()];
            timed.warm.push_back(block_ms(timed, frame, rounds.builds_per_block));
        }
        for (std::size_t i = 0; i < builders.size(); ++i) {
            Timed& timed = builders[(round + i) % builders.size()];
            for (std::uint32_t& word : sweep) word += 1;
            timed.cold.push_back(build_ms(timed, frame));
        }
    }
}

std::vector<double> ratios(const std::vector<double>& above, const std::vector<double>& below) {
    std::vector<double> result;
    for (std::size_t round = 0; round < std::min(above.size(), below.size()); ++round)
        if (below[round] > 0.0) result.push_back(above[round] / below[round]);
    return result;
}

const Timed* one_thread_of(const std::vector<Timed>& builders, const Timed& timed) {
    if (timed.choice.threads == 1) return nullptr;
    for (const Timed& other : builders)
        if (other.choice.name == timed.choice.name && other.choice.threads == 1) return &other;
    return nullptr;
}

Row row_of(const BuildCase& c, const std::vector<Timed>& builders, const Timed& timed) {
    const BuildCounts counts = timed.contender->counts();
    const Timed* one_thread = one_thread_of(builders, timed);
    return {{"builder", timed.choice.name},
            {"threads", timed.choice.threads},
            {"tile_px", counts.tile_px},
            {"scene", c.scene.name},
            {"distribution", c.lights.distribution},
            {"lights", c.lights.count},
            {"seed", c.lights.seed},
            {"width", c.width},
            {"height", c.height},
            {"visible_lights", counts.visible_lights},
            {"references", counts.references},
            {"structure_bytes", counts.bytes},
            {"build_ms", times_of(timed.warm)},
            {"cold_build_ms", times_of(timed.cold)},
            {"paper_over_this", times_of(ratios(builders.front().warm, timed.warm))},
            {"paper_over_this_cold", times_of(ratios(builders.front().cold, timed.cold))},
            {"this_over_floor", times_of(ratios(timed.warm, builders.back().warm))},
            {"one_thread_over_this", one_thread ? times_of(ratios(one_thread->warm, timed.warm)) : no_times()}};
}

} // namespace

std::span<const Column> build_columns() { return kColumns; }

const BuildFrame& BuildSource::frame(const BuildCase& c) {
    const std::string key = fmt::format("{} {}", c.scene.source, static_cast<int>(c.scene.detail));
    if (!scene_ || key != scene_key_) scene_ = load_scene(c.scene.source, c.scene.detail);
    scene_key_ = key;
    const Camera camera = case_camera(*scene_, {false, 0});
    frame_ = {make_view(camera, c.width, c.height), {}};
    for (const Light& light : make_lights(*scene_, camera, c.lights).lights) frame_.spheres.push_back(light.sphere);
    return frame_;
}

std::vector<Row> time_builds(const BuildCase& c, const BuildFrame& frame) {
    std::vector<Timed> builders = make_builders(frame);
    run_rounds(builders, frame, c.rounds);
    std::vector<Row> rows;
    for (const Timed& timed : builders) rows.push_back(row_of(c, builders, timed));
    return rows;
}

} // namespace manylights::lab::suites
