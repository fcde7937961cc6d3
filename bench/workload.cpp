#include "bench/workload.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace manylights::bench {
namespace {

// A 32-bit mixing of (light, stream), mapped to [0, 1).
float uniform(std::uint32_t light, std::uint32_t stream) {
    std::uint32_t x = light * 0x9E3779B9u + stream * 0x85EBCA6Bu;
    x = (x ^ (x >> 16)) * 0x21F0AAADu;
    x = (x ^ (x >> 15)) * 0x735A2D97u;
    x ^= x >> 15;
    return float(x >> 8) * 0x1p-24f;
}

} // namespace

std::vector<ManylightsSphere> canyon_like_lights(std::uint32_t count) {
    std::vector<ManylightsSphere> lights(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool large = uniform(i, 3) < 0.0005f;
        const float unit = uniform(i, 4);
        lights[i] = {{200.0f * (uniform(i, 0) - 0.5f), 60.0f * uniform(i, 1), 600.0f * (uniform(i, 2) - 0.5f)},
                     0.94f * (large ? 30.0f + 50.0f * unit : 2.0f + 6.0f * unit)};
    }
    return lights;
}

ManylightsView canyon_like_view() {
    const float cot_half = 1.0f / std::tan(0.5f * 1.04719755f);
    const float eye[3] = {0.0f, 20.0f, 280.0f}; // looks along -z
    ManylightsView view{};
    view.size = sizeof(view);
    for (int i = 0; i < 4; ++i) view.view_from_world[5 * i] = 1.0f;
    for (int i = 0; i < 3; ++i) view.view_from_world[12 + i] = -eye[i];
    view.clip_from_view[0] = cot_half * 1080.0f / 1920.0f;
    view.clip_from_view[5] = -cot_half;
    view.clip_from_view[11] = -1.0f;
    view.clip_from_view[14] = 0.1f;
    view.width = 1920;
    view.height = 1080;
    view.guard_px = 0.5f;
    return view;
}

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres) {
    return {sizeof(ManylightsLights), spheres.data(), sizeof(ManylightsSphere), std::uint32_t(spheres.size()), 0.0f};
}

double clock_hz() {
    constexpr int kRounds = 1 << 19, kAdditions = 16;
    double best = 0.0;
    for (int attempt = 0; attempt < 8; ++attempt) {
        std::uint64_t x = std::uint64_t(attempt);
        const auto start = std::chrono::steady_clock::now();
        for (int round = 0; round < kRounds; ++round) {
            for (int i = 0; i < kAdditions; ++i) {
                x += std::uint64_t(round);
                asm volatile("" : "+r"(x)); // keeps the additions a chain
            }
        }
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        best = std::max(best, double(kRounds) * kAdditions / time.count());
    }
    return best;
}

} // namespace manylights::bench
