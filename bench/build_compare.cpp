// Build times of all structures beside the paper's pipeline, in one run: every round builds a block of frames with each
// of them in turn, and a ratio is taken within a round, so that what slows the machine for a while slows both sides.
// Usage: build_compare [rounds] [lights...]

#include "bench/workload.h"
#include "reference/paper/pipeline.h"
#if defined(MANYLIGHTS_BENCH_SCENES)
#include "lab/scene/scene.h"
#endif

#include <manylights/manylights.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace manylights;

/// A view, and the lights that belong to it.
struct Frame {
    std::string name;
    ManylightsView view;
    std::vector<ManylightsSphere> spheres;

    ManylightsLights lights() const { return bench::lights_of(spheres); }
};

/// Of this thread: what others do on the machine does not count, but for the caches that they share.
double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Contender {
    std::string name;
    std::function<void(const Frame&)> build;
    std::vector<double> times; ///< medians of blocks
};

/// Buffers that only grow, as a renderer's.
struct Memory {
    std::vector<std::uint64_t> words[5];

    void* hold(int buffer, std::uint64_t bytes) {
        const std::size_t count = std::size_t(bytes / 8 + 4);
        if (words[buffer].size() < count) words[buffer].resize(count);
        const auto address = reinterpret_cast<std::uintptr_t>(words[buffer].data());
        return reinterpret_cast<void*>((address + 15) & ~std::uintptr_t{15});
    }
};

void check(const Status& status) {
    if (status) return;
    std::fprintf(stderr, "%s: %s %s\n", status.name(), status.report.field, status.report.rule);
    std::exit(1);
}

Contender ours(const char* name, std::uint32_t structure, std::uint32_t tile_px) {
    ManylightsSettings settings = make_settings();
    settings.structure = structure;
    settings.tile_px = tile_px;
    auto builder = std::make_shared<Builder>();
    auto memory = std::make_shared<Memory>();
    check(builder->create(settings));
    return {name,
            [builder, memory](const Frame& frame) {
                ManylightsSizes sizes{};
                check(builder->plan({&frame.view, 1}, frame.lights(), sizes));
                check(builder->write({memory->hold(0, sizes.views), memory->hold(1, sizes.slice_edges),
                                      memory->hold(2, sizes.cells), memory->hold(3, sizes.nodes),
                                      memory->hold(4, sizes.references)}));
            },
            {}};
}

Contender papers() {
    auto pipeline = std::make_shared<paper::PaperPipeline>();
    return {"paper hybrid 48",
            [pipeline](const Frame& frame) {
                pipeline->build({&frame.view, 1}, frame.lights(), {});
            },
            {}};
}

std::vector<Contender> make_contenders() {
    std::vector<Contender> contenders;
    contenders.push_back(papers());
    contenders.push_back(ours("hybrid 48", MANYLIGHTS_STRUCTURE_HYBRID, 48));
    contenders.push_back(ours("trees 48", MANYLIGHTS_STRUCTURE_TREES, 48));
    contenders.push_back(ours("lists 48", MANYLIGHTS_STRUCTURE_LISTS, 48));
    contenders.push_back(ours("windows 48", MANYLIGHTS_STRUCTURE_WINDOWS, 48));
    contenders.push_back(ours("windows 32", MANYLIGHTS_STRUCTURE_WINDOWS, 32));
    contenders.push_back(ours("windows chosen", MANYLIGHTS_STRUCTURE_WINDOWS, 0));
    return contenders;
}

double time_block(const Contender& contender, const Frame& frame, int frames) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) {
        const double begin = milliseconds();
        contender.build(frame);
        times.push_back(milliseconds() - begin);
    }
    return median(times);
}

void compare(const Frame& frame, int rounds) {
    std::vector<Contender> contenders = make_contenders();
    const int frames = frame.spheres.size() > 300000 ? 3 : 10;
    for (int round = -1; round < rounds; ++round)
        for (Contender& contender : contenders) {
            const double time = time_block(contender, frame, frames);
            if (round >= 0) contender.times.push_back(time); // the first round warms up
        }
    std::printf("%s, %zu lights\n", frame.name.c_str(), frame.spheres.size());
    for (const Contender& contender : contenders) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < contender.times.size(); ++i)
            ratios.push_back(contenders[0].times[i] / contender.times[i]);
        std::printf("  %-16s %9.3f ms   paper / this %6.2f\n", contender.name.c_str(), median(contender.times),
                    median(ratios));
    }
    std::fflush(stdout);
}

#if defined(MANYLIGHTS_BENCH_SCENES)
Frame frame_of(const char* name, std::uint32_t count) {
    const lab::Scene scene = lab::load_scene(name);
    const lab::Camera camera = lab::find_camera(scene, "");
    Frame frame{name, lab::make_view(camera, 1920, 1080), {}};
    for (const lab::Light& light : lab::make_lights(scene, camera, {.count = count}).lights)
        frame.spheres.push_back(light.sphere);
    return frame;
}

std::vector<Frame> make_frames(std::uint32_t count) { return {frame_of("canyon", count), frame_of("citadel", count)}; }
#else
std::vector<Frame> make_frames(std::uint32_t count) {
    return {{"canyon-like", bench::canyon_like_view(), bench::canyon_like_lights(count)}};
}
#endif

} // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 9;
    std::vector<std::uint32_t> counts = {65536, 1048576};
    if (argc > 2) counts.clear();
    for (int i = 2; i < argc; ++i) counts.push_back(std::uint32_t(std::strtoul(argv[i], nullptr, 10)));
    for (const std::uint32_t count : counts)
        for (const Frame& frame : make_frames(count)) compare(frame, std::max(rounds, 1));
    return 0;
}
