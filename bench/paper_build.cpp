// Build times of the paper's pipeline, the baseline of every other builder. Counters: cycles and nanoseconds per
// reference (cycles from the clock measured at the start), and the milliseconds of each stage.

#include "bench/workload.h"
#include "reference/paper/pipeline.h"
#if defined(MANYLIGHTS_BENCH_SCENES)
#include "lab/scene/scene.h"
#endif

#include <benchmark/benchmark.h>

namespace {

using namespace manylights;

// Builds the same frame over and over.
void run(benchmark::State& state, paper::Structure structure, const ManylightsView& view,
         const ManylightsLights& lights) {
    static const double clock = bench::clock_hz();
    paper::Options options;
    options.structure = structure;
    options.time_stages = true;
    paper::PaperPipeline pipeline;
    paper::StageTimes sums;
    double references = 0.0;
    for (auto _ : state) {
        const paper::Buffers& buffers = pipeline.build({&view, 1}, lights, options);
        references = double(buffers.references.size());
        sums.cull += buffers.times.cull;
        sums.sort += buffers.times.sort;
        sums.bounds += buffers.times.bounds;
        sums.bin += buffers.times.bin;
        sums.tree += buffers.times.tree;
        sums.pack += buffers.times.pack;
    }
    using benchmark::Counter;
    const double total = references * double(state.iterations());
    state.counters["references"] = references;
    state.counters["ns_per_ref"] = Counter(total * 1e-9, Counter::kIsRate | Counter::kInvert);
    state.counters["cycles_per_ref"] = Counter(total / clock, Counter::kIsRate | Counter::kInvert);
    state.counters["clock_GHz"] = clock * 1e-9;
    const std::pair<const char*, double> stages[] = {{"cull_ms", sums.cull},     {"sort_ms", sums.sort},
                                                     {"bounds_ms", sums.bounds}, {"bin_ms", sums.bin},
                                                     {"tree_ms", sums.tree},     {"pack_ms", sums.pack}};
    for (const auto& [name, sum] : stages) state.counters[name] = Counter(sum, Counter::kAvgIterations);
}

void paper_build(benchmark::State& state, paper::Structure structure) {
    const auto spheres = bench::canyon_like_lights(std::uint32_t(state.range(0)));
    run(state, structure, bench::canyon_like_view(), bench::lights_of(spheres));
}

#if defined(MANYLIGHTS_BENCH_SCENES)
// The scene itself: its first camera, lights uniform in its box, radii as the lab scales them.
void paper_build_canyon(benchmark::State& state, paper::Structure structure) {
    static const lab::Scene scene = lab::load_scene("canyon");
    const lab::Camera camera = lab::find_camera(scene, "");
    const auto count = std::uint32_t(state.range(0));
    const lab::LightSet set = lab::make_lights(scene, camera, {.count = count});
    const ManylightsLights lights{sizeof(ManylightsLights), set.lights.data(), sizeof(lab::Light), count, 0.0f};
    run(state, structure, lab::make_view(camera, 1920, 1080), lights);
}
#endif

void counts(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(8192)->Arg(65536)->Arg(262144)->Unit(benchmark::kMillisecond);
}

} // namespace

BENCHMARK_CAPTURE(paper_build, clustered, manylights::paper::Structure::clustered)->Apply(counts);
BENCHMARK_CAPTURE(paper_build, tree, manylights::paper::Structure::tree)->Apply(counts);
BENCHMARK_CAPTURE(paper_build, hybrid, manylights::paper::Structure::hybrid)->Apply(counts);

#if defined(MANYLIGHTS_BENCH_SCENES)
BENCHMARK_CAPTURE(paper_build_canyon, clustered, manylights::paper::Structure::clustered)->Apply(counts);
BENCHMARK_CAPTURE(paper_build_canyon, tree, manylights::paper::Structure::tree)->Apply(counts);
BENCHMARK_CAPTURE(paper_build_canyon, hybrid, manylights::paper::Structure::hybrid)->Apply(counts);
#endif

BENCHMARK_MAIN();
