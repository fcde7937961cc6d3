// Where the library's build spends its time, on one thread: milliseconds and cycles of each stage of docs/building.md.
// A block of lights goes through some of them at once, so these are told apart by doing less: culling alone, culling
// and spanning, all three. Measure, with placing, is what plan takes beside them. For structures with depth slices,
// span is boxes and their order, and record is to deal them to cells.

#include "bench/workload.h"
#include "src/build/record_stages.h"
#if defined(MANYLIGHTS_BENCH_SCENES)
#include "lab/scene/scene.h"
#endif

#include <manylights/manylights.hpp>

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace manylights;

struct Frame {
    std::vector<ManylightsSphere> spheres;
    ManylightsView view;
};

Frame canyon_like(std::uint32_t count) { return {bench::canyon_like_lights(count), bench::canyon_like_view()}; }

#if defined(MANYLIGHTS_BENCH_SCENES)
// The scene itself: its first camera, lights as the lab scales them.
Frame scene_frame(const char* name, std::uint32_t count) {
    const lab::Scene scene = lab::load_scene(name);
    const lab::Camera camera = lab::find_camera(scene, "");
    const lab::LightSet set = lab::make_lights(scene, camera, {.count = count});
    Frame frame{{}, lab::make_view(camera, 1920, 1080)};
    for (const lab::Light& light : set.lights) frame.spheres.push_back(light.sphere);
    return frame;
}
Frame canyon(std::uint32_t count) { return scene_frame("canyon", count); }
Frame citadel(std::uint32_t count) { return scene_frame("citadel", count); }
#endif

void require(bool condition) {
    if (!condition) std::abort();
}

// Of this thread on a processor: what else runs there counts less.
double thread_milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

double milliseconds_of(const auto& work) {
    const double start = thread_milliseconds();
    work();
    return thread_milliseconds() - start;
}

// Room for the caller's buffers.
struct Output {
    std::vector<ManylightsSphere> memory[5]; // units of 16 bytes

    void* hold(int buffer, std::uint64_t bytes) {
        memory[buffer].resize(static_cast<std::size_t>(bytes / sizeof(ManylightsSphere) + 1));
        return memory[buffer].data();
    }
    ManylightsBuffers buffers(const ManylightsSizes& sizes) {
        return {hold(0, sizes.views), hold(1, sizes.slice_edges), hold(2, sizes.cells), hold(3, sizes.nodes),
                hold(4, sizes.references)};
    }
};

// Culls all blocks into the same scratch; spans them too, if wanted.
class BlockWork {
  public:
    void run(ManylightsBuilder& builder, const ManylightsLights& lights, bool spans_too) {
        const detail::ViewCull cull = detail::make_view_cull(builder.views[0].camera, lights.motion_margin);
        const detail::Grid& grid = builder.grids[0];
        const detail::SpanView view = {grid.tile_px, grid.width - 1, grid.height - 1};
        detail::LightBlock block = {floats(0), floats(1), floats(2), floats(3), words(0), words(1), words(2), 0};
        const detail::BlockSpans spans = {spheres_.data(), tiles_.data(), words(3), ends_};
        for (std::uint64_t b = 0; b < detail::block_count_for(lights.count); ++b) {
            detail::cull_block(cull, detail::block_span(lights, b), block);
            if (spans_too) detail::span_block(view, block, spans);
        }
    }

  private:
    float* floats(std::size_t i) { return floats_.data() + i * detail::kBlockRoom; }
    std::uint32_t* words(std::size_t i) { return words_.data() + i * detail::kBlockRoom; }

    std::vector<float> floats_ = std::vector<float>(4 * std::size_t{detail::kBlockRoom});
    std::vector<std::uint32_t> words_ = std::vector<std::uint32_t>(4 * std::size_t{detail::kBlockRoom});
    std::vector<detail::SpanSphere> spheres_ = std::vector<detail::SpanSphere>(detail::kBlockRoom);
    std::vector<detail::SpanTiles> tiles_ = std::vector<detail::SpanTiles>(detail::kBlockRoom);
    std::uint32_t ends_[detail::kSpanGroups];
};

// Milliseconds from the beginning.
struct LightStages {
    double spanned, recorded;
};
LightStages run_light_stages(ManylightsBuilder& builder, const ManylightsLights& lights, BlockWork& blocks) {
    if (!detail::has_windows(builder)) {
        const double ordered = milliseconds_of([&] { require(detail::order_boxes(builder, lights)); });
        return {ordered, ordered + milliseconds_of([&] { require(detail::deal_lights(builder)); })};
    }
    return {milliseconds_of([&] { blocks.run(builder, lights, true); }), milliseconds_of([&] {
                require(detail::collect_records(builder, lights, UINT32_MAX, true) == detail::Fit::kFits);
            })};
}

struct StageTimes {
    double sample = 0.0, cull = 0.0, span = 0.0, record = 0.0, measure = 0.0, write = 0.0;
};

void report(benchmark::State& state, const StageTimes& sums, std::uint64_t lights, std::uint64_t references) {
    using benchmark::Counter;
    static const double clock = bench::clock_hz();
    const std::pair<const char*, double> stages[] = {{"sample", sums.sample},   {"cull", sums.cull},
                                                     {"span", sums.span},       {"record", sums.record},
                                                     {"measure", sums.measure}, {"write", sums.write}};
    for (const auto& [name, sum] : stages)
        state.counters[std::string(name) + "_ms"] = Counter(sum, Counter::kAvgIterations);
    const double per_second = clock * 1e-3 / double(state.iterations());
    state.counters["references"] = double(references);
    state.counters["lights_cycles"] = (sums.cull + sums.span) * per_second / double(lights);
    state.counters["record_cycles"] = sums.record * per_second / double(references);
    state.counters["tile_cycles"] = (sums.measure + sums.write) * per_second / double(references);
    state.counters["clock_GHz"] = clock * 1e-9;
}

void library_build(benchmark::State& state, Frame (*make)(std::uint32_t), ManylightsStructure structure,
                   std::uint32_t tile_px) {
    const Frame frame = make(std::uint32_t(state.range(0)));
    const ManylightsLights lights = bench::lights_of(frame.spheres);
    ManylightsSettings settings = make_settings();
    settings.structure = structure;
    settings.tile_px = tile_px;
    ManylightsBuilder* builder = nullptr;
    require(manylights_create(&settings, &builder, nullptr) == MANYLIGHTS_OK);
    ManylightsSizes sizes{};
    Output output;
    BlockWork blocks;
    StageTimes sums;
    for (auto _ : state) {
        const double plan = milliseconds_of(
            [&] { require(manylights_plan(builder, &frame.view, 1, &lights, &sizes, nullptr) == MANYLIGHTS_OK); });
        const ManylightsBuffers buffers = output.buffers(sizes);
        sums.write += milliseconds_of([&] { require(manylights_write(builder, &buffers, nullptr) == MANYLIGHTS_OK); });
        const double sample = milliseconds_of([&] { require(detail::take_sample(*builder, lights)); });
        const double cull = milliseconds_of([&] { blocks.run(*builder, lights, false); });
        const LightStages stages = run_light_stages(*builder, lights, blocks);
        sums.sample += sample;
        sums.cull += cull;
        sums.span += stages.spanned - cull;
        sums.record += stages.recorded - stages.spanned;
        sums.measure += plan - sample - stages.recorded;
    }
    ManylightsStats stats{};
    manylights_stats(builder, &stats);
    report(state, sums, frame.spheres.size(), stats.references);
    manylights_destroy(builder);
}

void register_all(const char* scene, Frame (*make)(std::uint32_t)) {
    const struct {
        const char* name;
        ManylightsStructure structure;
        std::uint32_t tile_px;
    } structures[] = {{"windows", MANYLIGHTS_STRUCTURE_WINDOWS, 32},
                      {"windows_48", MANYLIGHTS_STRUCTURE_WINDOWS, 48},
                      {"hybrid", MANYLIGHTS_STRUCTURE_HYBRID, 48},
                      {"trees", MANYLIGHTS_STRUCTURE_TREES, 48},
                      {"lists", MANYLIGHTS_STRUCTURE_LISTS, 48}};
    for (const auto& s : structures)
        benchmark::RegisterBenchmark((std::string("library_build/") + scene + "/" + s.name).c_str(), library_build,
                                     make, s.structure, s.tile_px)
            ->Arg(8192)
            ->Arg(65536)
            ->Arg(1048576)
            ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    register_all("canyon_like", canyon_like);
#if defined(MANYLIGHTS_BENCH_SCENES)
    register_all("canyon", canyon);
    register_all("citadel", citadel);
#endif
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
