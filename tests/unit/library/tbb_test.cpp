// The adapter for oneTBB: the same bytes, and on its threads.

#include "manylights/manylights_tbb.hpp"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace manylights::test {
namespace {

TEST(Tbb, CallsEachTaskOnce) {
    tbb::task_arena arena(3);
    for (tbb::task_arena* where : {static_cast<tbb::task_arena*>(nullptr), &arena}) {
        for (const std::uint32_t count : {1u, 2u, 7u, 1000u}) {
            std::vector<std::atomic<int>> calls(count);
            run_on_tbb(
                where, count,
                [](void* context, std::uint32_t i) { ++(*static_cast<std::vector<std::atomic<int>>*>(context))[i]; },
                &calls);
            for (const std::atomic<int>& each : calls) ASSERT_EQ(each.load(), 1);
        }
    }
}

TEST(Tbb, BuildsTheSameBytes) {
    const auto spheres = make_lights(30000, 8, 50.0, 0.5, 6.0);
    for (std::uint32_t structure = MANYLIGHTS_STRUCTURE_LISTS; structure <= MANYLIGHTS_STRUCTURE_WINDOWS; ++structure) {
        const BuilderPtr serial = make_builder(settings_of(structure));
        const std::string expected = build_frame(serial.get(), {make_view()}, spheres).bytes();
        tbb::task_arena arena(4);
        ManylightsSettings settings = settings_of(structure);
        use_tbb(settings, &arena);
        EXPECT_EQ(settings.max_workers, 4u);
        const BuilderPtr builder = make_builder(settings);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(build_frame(builder.get(), {make_view()}, spheres).bytes(), expected);
    }
}

} // namespace
} // namespace manylights::test
