// The same bytes from every instruction set and every number of tasks, and the same as ever.

#include "tests/unit/library/frame.h"

#include <hwy/targets.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

namespace manylights::test {
namespace {

/// Takes one instruction set away from all others while it lives.
class OnlyTarget {
  public:
    explicit OnlyTarget(std::int64_t target) { choose(target); }
    ~OnlyTarget() { choose(0); }
    OnlyTarget(const OnlyTarget&) = delete;
    OnlyTarget& operator=(const OnlyTarget&) = delete;

  private:
    static void choose(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

/// Those that this processor has. The library leaves some out; then the next worse one is tested twice.
std::vector<std::int64_t> targets() {
    std::vector<std::int64_t> found;
    const std::int64_t all = hwy::SupportedTargets();
    for (int bit = 0; bit < 63; ++bit)
        if ((all >> bit & 1) != 0) found.push_back(std::int64_t{1} << bit);
    return found;
}

/// Lights of all kinds: small and large, around the camera, far, extreme, and ignored ones. Several blocks of them.
std::vector<ManylightsSphere> mixed_lights() {
    std::vector<ManylightsSphere> lights = make_lights(20000, 31, 60.0, 0.1, 4.0);
    for (const ManylightsSphere& light : make_lights(300, 32, 80.0, 10.0, 60.0)) lights.push_back(light);
    for (const ManylightsSphere& light : make_lights(300, 33, 2.0, 0.01, 3.0)) lights.push_back(light);
    const float huge[] = {1e6f, 1e18f, 3e38f};
    for (const float range : huge) lights.push_back({{3.0f, 1.0f, -20.0f}, range});
    lights.push_back({{0.0f, 0.0f, -1e30f}, 1e18f});
    lights.push_back({{-3e38f, 3e38f, -3e38f}, 3e38f});
    lights.push_back({{0.0f, 0.0f, -1e-11f}, 1e-12f});
    lights.push_back({{0.0f, 0.0f, -10.0f}, -1.0f});
    return lights;
}

std::vector<ManylightsView> mixed_views() {
    CameraOptions mirrored;
    mirrored.yaw = 2.0;
    mirrored.width = 333;
    mirrored.looks_down_negative_z = false;
    return {make_view(), make_view(mirrored)};
}

std::uint64_t hash_of(const std::string& bytes) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3u;
    return hash;
}

void run_on_threads(void*, std::uint32_t count, ManylightsTask task, void* context) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < count; ++i) threads.emplace_back(task, context, i);
    for (std::thread& thread : threads) thread.join();
}

std::uint64_t frame_hash(std::uint32_t structure, std::uint32_t workers) {
    ManylightsSettings settings = settings_of(structure);
    settings.max_workers = workers;
    settings.parallel_for = workers > 1 ? run_on_threads : nullptr;
    const BuilderPtr builder = make_builder(settings);
    return hash_of(build_frame(builder.get(), mixed_views(), mixed_lights()).bytes());
}

struct Pinned {
    std::uint32_t structure;
    std::uint64_t hash;
};

constexpr Pinned kPinned[] = {
    {MANYLIGHTS_STRUCTURE_LISTS, 0xB3617234EB6B66DFu},
    {MANYLIGHTS_STRUCTURE_TREES, 0x96C47981AF76D3BBu},
    {MANYLIGHTS_STRUCTURE_HYBRID, 0x8B812DB4A511E97Cu},
    {MANYLIGHTS_STRUCTURE_WINDOWS, 0xFD7E5E947D0C9C06u},
};

TEST(Targets, MakeTheSameBytesAsEver) {
    for (const std::int64_t target : targets()) {
        const OnlyTarget only(target);
        for (const Pinned& pinned : kPinned)
            EXPECT_EQ(frame_hash(pinned.structure, 1), pinned.hash)
                << hwy::TargetName(target) << ", structure " << pinned.structure;
    }
}

TEST(Targets, MakeTheSameBytesWithAnyNumberOfTasks) {
    for (const std::int64_t target : targets()) {
        const OnlyTarget only(target);
        for (const Pinned& pinned : kPinned)
            for (const std::uint32_t workers : {2u, 3u, 7u})
                EXPECT_EQ(frame_hash(pinned.structure, workers), pinned.hash)
                    << hwy::TargetName(target) << ", structure " << pinned.structure << ", " << workers << " tasks";
    }
}

} // namespace
} // namespace manylights::test
