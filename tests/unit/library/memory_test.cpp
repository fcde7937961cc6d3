// Memory: none is asked for after warm-up, all of it is returned, and each refusal is reported and survived.

#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace manylights::test {
namespace {

// Counts, checks each release against its allocation, and refuses the allocation of one index.
struct Heap {
    std::map<void*, std::size_t> live;
    int allocations = 0;
    int refuse = -1;
    bool refuse_later_ones = false;

    void install(ManylightsSettings& settings) {
        settings.allocator_user = this;
        settings.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
            Heap& heap = *static_cast<Heap*>(user);
            const int index = heap.allocations++;
            if (index == heap.refuse || (heap.refuse_later_ones && index > heap.refuse && heap.refuse >= 0))
                return nullptr;
            EXPECT_GT(bytes, 0u);
            EXPECT_EQ(alignment & (alignment - 1), 0u);
            void* memory = std::malloc(bytes);
            heap.live[memory] = bytes;
            return memory;
        };
        settings.release = [](void* user, void* memory, std::size_t bytes) {
            Heap& heap = *static_cast<Heap*>(user);
            const auto found = heap.live.find(memory);
            ASSERT_NE(found, heap.live.end());
            EXPECT_EQ(found->second, bytes);
            heap.live.erase(found);
            std::free(memory);
        };
    }
};

constexpr std::uint32_t kStructures[] = {MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                         MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS};

TEST(Memory, NothingIsAllocatedAfterWarmUp) {
    for (const std::uint32_t structure : kStructures) {
        Heap heap;
        ManylightsSettings settings = settings_of(structure);
        heap.install(settings);
        {
            const BuilderPtr builder = make_builder(settings);
            const auto spheres = make_lights(2000, 4, 40.0, 0.5, 5.0);
            Frame first = build_frame(builder.get(), {make_view(), make_view()}, spheres);
            validate(builder.get(), first, 2000);
            const int warm = heap.allocations;
            EXPECT_GT(warm, 5);
            for (int i = 0; i < 3; ++i) {
                Frame again = build_frame(builder.get(), {make_view(), make_view()}, spheres);
                EXPECT_EQ(again.bytes(), first.bytes());
                build_frame(builder.get(), {make_view()}, make_lights(1000, 5, 40.0, 0.5, 4.0));
                validate(builder.get(), again, 2000);
            }
            EXPECT_EQ(heap.allocations, warm);
        }
        EXPECT_TRUE(heap.live.empty());
    }
}

ManylightsStatus run_all(ManylightsBuilder* builder, const std::vector<ManylightsSphere>& spheres, Frame& frame) {
    const ManylightsView view = make_view();
    const ManylightsLights lights = lights_of(spheres);
    ManylightsSizes sizes{};
    ManylightsReport report{};
    ManylightsStatus status = manylights_plan(builder, &view, 1, &lights, &sizes, &report);
    if (status != MANYLIGHTS_OK) {
        EXPECT_STRNE(report.field, "");
        const ManylightsBuffers none{};
        EXPECT_EQ(manylights_write(builder, &none, nullptr), MANYLIGHTS_NOT_PLANNED);
        return status;
    }
    frame.allocate(sizes);
    const ManylightsBuffers buffers = frame.buffers();
    EXPECT_EQ(manylights_write(builder, &buffers, nullptr), MANYLIGHTS_OK) << "write allocates nothing";
    return manylights_validate(builder, &buffers, &sizes, lights.count, &report);
}

// Refuses each allocation in turn: one status, nothing leaks, and the same builder works once memory is back.
TEST(Memory, EachRefusedAllocationIsReportedAndSurvived) {
    for (const std::uint32_t structure : kStructures) {
        const auto spheres = make_lights(500, 4, 40.0, 0.5, 5.0);
        Frame expected;
        {
            const BuilderPtr builder = make_builder(settings_of(structure));
            ASSERT_EQ(run_all(builder.get(), spheres, expected), MANYLIGHTS_OK);
        }
        for (int refuse = 0;; ++refuse) {
            Heap heap;
            heap.refuse = refuse;
            heap.refuse_later_ones = refuse % 2 == 1;
            ManylightsSettings settings = settings_of(structure);
            heap.install(settings);
            ManylightsBuilder* created = nullptr;
            const ManylightsStatus status = manylights_create(&settings, &created, nullptr);
            const BuilderPtr builder(created);
            if (refuse == 0) {
                ASSERT_EQ(status, MANYLIGHTS_OUT_OF_MEMORY);
                continue;
            }
            Frame frame;
            const ManylightsStatus first = run_all(created, spheres, frame);
            if (heap.allocations <= refuse) {
                EXPECT_EQ(first, MANYLIGHTS_OK);
                EXPECT_GT(refuse, 5);
                break;
            }
            EXPECT_EQ(first, MANYLIGHTS_OUT_OF_MEMORY) << refuse;
            heap.refuse = -1;
            EXPECT_EQ(run_all(created, spheres, frame), MANYLIGHTS_OK) << refuse;
            EXPECT_EQ(frame.bytes(), expected.bytes()) << refuse;
        }
    }
}

} // namespace
} // namespace manylights::test
