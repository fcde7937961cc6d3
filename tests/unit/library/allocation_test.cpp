// No allocation per frame: everything that this program takes from the heap is counted, whoever asks for it.

#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};

void* count_and_allocate(std::size_t bytes) {
    ++allocations;
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    throw std::bad_alloc();
}

} // namespace

// The other forms of the standard library lead to these. Never inlined: where only one of a pair is, GCC sees `free`
// meet what `new` returned and takes it for an error (-Wmismatched-new-delete).
[[gnu::noinline]] void* operator new(std::size_t bytes) { return count_and_allocate(bytes); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace manylights::test {
namespace {

// Allocates through the settings, counted like the rest.
void count_memory(ManylightsSettings& settings) {
    settings.allocate = [](void*, std::size_t bytes, std::size_t alignment) -> void* {
        ++allocations;
        EXPECT_LE(alignment, alignof(std::max_align_t));
        return std::malloc(bytes);
    };
    settings.release = [](void*, void* memory, std::size_t) { std::free(memory); };
}

// As many tasks as a pool of threads would be handed, without threads: those would allocate for themselves.
void split_work(ManylightsSettings& settings) {
    settings.max_workers = 4;
    settings.parallel_for = [](void*, std::uint32_t count, ManylightsTask task, void* context) {
        for (std::uint32_t i = 0; i < count; ++i) task(context, i);
    };
}

struct Path {
    std::vector<ManylightsSphere> spheres = make_lights(20000, 4, 40.0, 0.5, 5.0);
    std::vector<ManylightsView> views;

    Path() {
        for (int i = 0; i < 6; ++i) {
            CameraOptions camera;
            camera.position = {-10.0 + 4.0 * i, 0.0, 30.0 - 8.0 * i};
            camera.yaw = 0.3 * i;
            views.push_back(make_view(camera));
        }
    }
};

// What plan and write allocate on the way along the path; the buffers are the renderer's.
std::uint64_t allocations_along(const Path& path, ManylightsBuilder* builder, Frame& frame) {
    std::uint64_t sum = 0;
    const ManylightsLights lights = lights_of(path.spheres);
    for (const ManylightsView& view : path.views) {
        ManylightsSizes sizes{};
        std::uint64_t before = allocations;
        EXPECT_EQ(manylights_plan(builder, &view, 1, &lights, &sizes, nullptr), MANYLIGHTS_OK);
        sum += allocations - before;
        frame.allocate(sizes);
        const ManylightsBuffers buffers = frame.buffers();
        before = allocations;
        EXPECT_EQ(manylights_write(builder, &buffers, nullptr), MANYLIGHTS_OK);
        sum += allocations - before;
    }
    return sum;
}

constexpr std::uint32_t kStructures[] = {MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                         MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS};

TEST(Allocations, none_once_a_path_has_been_walked) {
    const Path path;
    for (const std::uint32_t structure : kStructures) {
        for (const bool split : {false, true}) {
            ManylightsSettings settings = settings_of(structure);
            count_memory(settings);
            if (split) split_work(settings);
            const BuilderPtr builder = make_builder(settings);
            Frame frame;
            EXPECT_GT(allocations_along(path, builder.get(), frame), 5u) << "the counter counts";
            for (int round = 0; round < 3; ++round)
                EXPECT_EQ(allocations_along(path, builder.get(), frame), 0u)
                    << "structure " << structure << (split ? ", split" : "");
        }
    }
}

} // namespace
} // namespace manylights::test
