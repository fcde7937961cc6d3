// Whole frames: threads, views, budgets, repeats, and the C++ wrapper.

#include "manylights/manylights.hpp"
#include "src/build/builder.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

namespace manylights::test {
namespace {

constexpr std::uint32_t kStructures[] = {MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                         MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS};

// Runs tasks on as many threads, last one first.
struct Threads {
    std::atomic<std::uint32_t> most_tasks{0};

    void install(ManylightsSettings& settings, std::uint32_t workers) {
        settings.max_workers = workers;
        settings.parallel_user = this;
        settings.parallel_for = [](void* user, std::uint32_t count, ManylightsTask task, void* context) {
            auto& self = *static_cast<Threads*>(user);
            self.most_tasks = std::max(self.most_tasks.load(), count);
            std::vector<std::thread> threads;
            for (std::uint32_t i = count; i-- > 0;) threads.emplace_back(task, context, i);
            for (std::thread& thread : threads) thread.join();
        };
    }
};

// Lights enough for tasks of their own in every stage: eight blocks.
TEST(Threads, AnyNumberOfWorkersWritesTheSameBytes) {
    const auto spheres = make_lights(30000, 8, 50.0, 0.5, 6.0);
    for (const std::uint32_t structure : kStructures) {
        const BuilderPtr serial = make_builder(settings_of(structure));
        const std::string expected = build_frame(serial.get(), {make_view(), make_view()}, spheres).bytes();
        for (const std::uint32_t workers : {1u, 2u, 3u, 7u, 1024u}) {
            Threads threads;
            ManylightsSettings settings = settings_of(structure);
            threads.install(settings, workers);
            const BuilderPtr builder = make_builder(settings);
            EXPECT_EQ(build_frame(builder.get(), {make_view(), make_view()}, spheres).bytes(), expected) << workers;
            EXPECT_LE(threads.most_tasks.load(), workers);
            EXPECT_TRUE(workers == 1 || threads.most_tasks.load() >= std::min(workers, 7u)) << "work is shared";
        }
    }
}

TEST(Threads, TwoBuildersWorkSideBySide) {
    const auto spheres = make_lights(1500, 8, 50.0, 0.5, 6.0);
    const BuilderPtr reference = make_builder(settings_of(MANYLIGHTS_STRUCTURE_HYBRID));
    const std::string expected = build_frame(reference.get(), {make_view()}, spheres).bytes();
    std::string found[2];
    std::vector<std::thread> threads;
    for (std::string& bytes : found) {
        threads.emplace_back([&] {
            const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_HYBRID));
            for (int i = 0; i < 5; ++i) bytes = build_frame(builder.get(), {make_view()}, spheres).bytes();
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found[0], expected);
    EXPECT_EQ(found[1], expected);
}

TEST(Write, TwiceGivesTheSameBytes) {
    for (const std::uint32_t structure : kStructures) {
        const BuilderPtr builder = make_builder(settings_of(structure));
        const Frame first = build_frame(builder.get(), {make_view()}, make_lights(800, 2, 30.0, 1.0, 5.0));
        Frame second;
        second.allocate(first.sizes);
        std::fill(second.references.begin(), second.references.end(), 1u);
        const ManylightsBuffers buffers = second.buffers();
        ASSERT_EQ(manylights_write(builder.get(), &buffers, nullptr), MANYLIGHTS_OK);
        EXPECT_EQ(second.bytes(), first.bytes());
    }
}

// The room for records is judged by a sample, which does not see that these few lights take nearly all of it.
TEST(Records, TakeTheRoomThatTheyNeed) {
    constexpr std::uint32_t kFew = 60;
    for (const std::uint32_t structure : kStructures) {
        ManylightsSettings settings = settings_of(structure);
        settings.tile_px = 8;
        for (std::uint32_t at = 0; at < 200000; at += 25000) {
            std::vector<ManylightsSphere> spheres(200000, {{0.0f, 0.0f, 100.0f}, 1.0f}); // behind the camera
            for (std::uint32_t i = 0; i < kFew; ++i) spheres[at + i] = {{0.0f, 0.0f, -10.0f}, 1000.0f};
            const BuilderPtr builder = make_builder(settings);
            Frame frame = build_frame(builder.get(), {make_view()}, spheres);
            ASSERT_EQ(validate(builder.get(), frame, 200000).status, MANYLIGHTS_OK);
            ASSERT_EQ(lights_at(frame, 0, 160.5f, 90.5f, 10.0f).size(), kFew) << structure << " " << at;
            ASSERT_EQ(lights_at(frame, 0, 319.5f, 0.5f, 200.0f).size(), kFew) << structure << " " << at;
        }
    }
}

// A builder lays out its records by the last frame's. Whatever that was, the bytes are those of a new one.
TEST(Records, DoNotShowWhatTheLastFrameWas) {
    std::vector<ManylightsSphere> near_left, far_right;
    for (const ManylightsSphere& light : make_lights(6000, 41, 10.0, 0.2, 2.0)) {
        near_left.push_back({{light.center[0] - 12.0f, light.center[1], light.center[2] - 20.0f}, light.range});
        far_right.push_back({{light.center[0] + 12.0f, light.center[1] + 4.0f, light.center[2] - 25.0f}, light.range});
    }
    const std::vector<ManylightsSphere> few(near_left.begin(), near_left.begin() + 40);
    const std::vector<const std::vector<ManylightsSphere>*> frames = {&near_left, &far_right, &few,
                                                                      &far_right, &far_right, &near_left};
    for (const std::uint32_t structure : kStructures) {
        const BuilderPtr builder = make_builder(settings_of(structure));
        for (const auto* spheres : frames) {
            const BuilderPtr fresh = make_builder(settings_of(structure));
            const Frame expected = build_frame(fresh.get(), {make_view()}, *spheres);
            ASSERT_GT(expected.references.size(), spheres->size() / 2);
            ASSERT_EQ(build_frame(builder.get(), {make_view()}, *spheres).bytes(), expected.bytes()) << structure;
        }
    }
}

// Each of eight views gives what it gives alone, at its place in the shared buffers.
TEST(Views, EightAtOnceGiveWhatEachGivesAlone) {
    const auto spheres = make_lights(1500, 12, 40.0, 0.5, 4.0);
    for (const std::uint32_t structure : kStructures) {
        const BuilderPtr builder = make_builder(settings_of(structure));
        std::vector<ManylightsView> views;
        for (int v = 0; v < 8; ++v) {
            CameraOptions options;
            options.yaw = 0.8 * v;
            options.width = 100u + 37u * static_cast<std::uint32_t>(v);
            options.looks_down_negative_z = v % 2 == 0;
            views.push_back(make_view(options));
        }
        Frame all = build_frame(builder.get(), views, spheres);
        ASSERT_EQ(validate(builder.get(), all, 1500).status, MANYLIGHTS_OK);
        ManylightsStats stats{};
        manylights_stats(builder.get(), &stats);
        EXPECT_EQ(stats.references, all.reference_count());
        EXPECT_EQ(stats.nodes, all.nodes.size());
        EXPECT_EQ(stats.cells, all.list_count());
        EXPECT_EQ(stats.cells, stats.empty_cells + stats.list_cells + stats.tree_cells);
        std::uint64_t visible = 0;
        const BuilderPtr single = make_builder(settings_of(structure));
        for (std::uint32_t v = 0; v < 8; ++v) {
            Frame alone = build_frame(single.get(), {views[v]}, spheres);
            ASSERT_EQ(alone.cells.size(), all.views[v].cell_count);
            for (std::uint32_t c = 0; c < alone.list_count(); ++c)
                ASSERT_EQ(lights_of_cell(alone, c * alone.cells_each()),
                          lights_of_cell(all, all.views[v].cell_offset + c * all.cells_each()));
            const std::uint32_t* indices = nullptr;
            std::uint32_t count = 0;
            ASSERT_EQ(manylights_visible(builder.get(), v, &indices, &count, nullptr), MANYLIGHTS_OK);
            EXPECT_TRUE(std::is_sorted(indices, indices + count));
            visible += count;
        }
        EXPECT_EQ(stats.visible_lights, visible);
    }
}

TEST(Stats, TellListsFromTrees) {
    const auto spheres = make_lights(4000, 8, 200.0, 0.5, 3.0);
    ManylightsStats stats{};
    const auto build = [&](std::uint32_t structure) {
        const BuilderPtr builder = make_builder(settings_of(structure));
        build_frame(builder.get(), {make_view()}, spheres);
        manylights_stats(builder.get(), &stats);
    };
    build(MANYLIGHTS_STRUCTURE_LISTS);
    EXPECT_EQ(stats.tree_cells, 0u);
    EXPECT_EQ(stats.nodes, 0u);
    EXPECT_GT(stats.list_cells, 0u);
    build(MANYLIGHTS_STRUCTURE_TREES);
    EXPECT_GT(stats.tree_cells, 0u);
    build(MANYLIGHTS_STRUCTURE_HYBRID);
    EXPECT_GT(stats.tree_cells, 0u);
    EXPECT_GT(stats.list_cells, 0u);
}

// As many lights as a leaf holds make a tree of one leaf, and that is a list.
TEST(Stats, CountATreeOfOneLeafAsAList) {
    const std::vector<ManylightsSphere> four(4, {{0, 0, -10}, 1});
    for (const std::uint32_t leaf_size : {4u, 3u}) {
        ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_TREES);
        settings.leaf_size = leaf_size;
        settings.tile_px = 512;
        const BuilderPtr builder = make_builder(settings);
        build_frame(builder.get(), {make_view()}, four);
        ManylightsStats stats{};
        manylights_stats(builder.get(), &stats);
        EXPECT_EQ(stats.list_cells, leaf_size == 4 ? 1u : 0u);
        EXPECT_EQ(stats.tree_cells, leaf_size == 4 ? 0u : 1u);
    }
}

std::uint64_t budget_bytes(std::uint32_t structure, std::uint64_t max_bytes, ManylightsStats& stats, Frame& frame) {
    ManylightsSettings settings = settings_of(structure);
    settings.max_bytes = max_bytes;
    settings.tile_px = 16;
    const BuilderPtr builder = make_builder(settings);
    const auto spheres = make_lights(1500, 8, 40.0, 0.5, 6.0);
    frame = build_frame(builder.get(), {make_view()}, spheres);
    EXPECT_EQ(validate(builder.get(), frame, 1500).status, MANYLIGHTS_OK);
    manylights_stats(builder.get(), &stats);
    EXPECT_EQ(stats.bytes, frame.bytes().size());
    return stats.bytes;
}

// Over budget is coarser, never wrong.
TEST(Budget, CoarsensTilesUntilTheBytesFit) {
    for (const std::uint32_t structure : kStructures) {
        ManylightsStats stats{};
        Frame fine;
        Frame coarse;
        const std::uint64_t full = budget_bytes(structure, 0, stats, fine);
        EXPECT_EQ(stats.tile_px, 16u);
        EXPECT_EQ(budget_bytes(structure, full, stats, coarse), full) << "a budget that fits changes nothing";
        EXPECT_EQ(stats.tile_px, 16u);
        EXPECT_LE(budget_bytes(structure, full - 1, stats, coarse), full - 1);
        EXPECT_EQ(stats.tile_px, 32u);
        EXPECT_EQ(stats.over_budget, 0u);
        EXPECT_EQ(coarse.views[0].tile_px, 32u);
        EXPECT_LE(budget_bytes(structure, full / 8, stats, coarse), full / 8);
        EXPECT_GT(stats.tile_px, 32u);
        // Whatever a fine cell hands out, the coarse one does too.
        Random random(1);
        for (int i = 0; i < 200; ++i) {
            const float x = random.between(0, 320);
            const float y = random.between(0, 180);
            const float depth = random.between(0.1, 60);
            const auto narrow = lights_at(fine, 0, x, y, depth);
            auto wide = lights_at(coarse, 0, x, y, depth);
            std::sort(wide.begin(), wide.end());
            for (const MlUint light : narrow)
                ASSERT_TRUE(structure != MANYLIGHTS_STRUCTURE_LISTS ||
                            std::binary_search(wide.begin(), wide.end(), light));
        }
        budget_bytes(structure, 1, stats, coarse);
        EXPECT_EQ(stats.over_budget, 1u);
        EXPECT_EQ(coarse.views[0].tiles_x * coarse.views[0].tiles_y, 1u);
    }
}

// More than 2^32 - 1 references or cells at the tile size asked for: coarser tiles serve it.
TEST(Budget, CountsBeyond32BitsCoarsenToo) {
    CameraOptions options;
    options.width = options.height = 65536;
    ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_LISTS);
    settings.tile_px = 8;
    settings.slice_count = 128; // 8192 * 8192 * 128 cells
    settings.max_bytes = 1 << 20;
    const BuilderPtr builder = make_builder(settings);
    Frame frame = build_frame(builder.get(), {make_view(options)}, make_lights(40, 8, 40.0, 0.5, 6.0));
    EXPECT_EQ(validate(builder.get(), frame, 40).status, MANYLIGHTS_OK);
    EXPECT_LE(frame.bytes().size(), 1u << 20);
}

// 32-bit offsets bound references, nodes and cells alike. Reaching them takes gigabytes, so the bound comes down to the
// test: coarser tiles are tried first, and where one tile per view is still too much, that is said.
TEST(Budget, WhatNoOffsetReachesIsTooLarge) {
    const auto spheres = make_lights(300, 8, 40.0, 5.0, 6.0);
    const ManylightsLights lights = lights_of(spheres);
    const ManylightsView view = make_view();
    for (const std::uint32_t structure : kStructures) {
        ManylightsSettings settings = settings_of(structure);
        settings.tile_px = 8;
        const BuilderPtr builder = make_builder(settings);
        ManylightsSizes sizes{};
        ManylightsReport report{};
        builder->most_elements = 500;
        ManylightsStatus status = manylights_plan(builder.get(), &view, 1, &lights, &sizes, &report);
        ManylightsStats stats{};
        manylights_stats(builder.get(), &stats);
        EXPECT_EQ(status, MANYLIGHTS_OK) << structure;
        EXPECT_GT(stats.tile_px, 8u);
        EXPECT_LE(std::max({stats.references, stats.nodes, stats.cells}), 500u);
        EXPECT_LE(std::max(sizes.references / sizeof(MlUint), sizes.cells / sizeof(MlCell)), 500u);

        builder->most_elements = 20;
        status = manylights_plan(builder.get(), &view, 1, &lights, &sizes, &report);
        EXPECT_EQ(status, MANYLIGHTS_TOO_LARGE) << structure;
        EXPECT_STREQ(report.field, "lights.count");
        EXPECT_EQ(sizes.references, 0u);
    }
}

TEST(Wrapper, WrapsEachCall) {
    Builder builder;
    ManylightsSizes sizes{};
    const auto spheres = make_lights(100, 1, 20.0, 1.0, 3.0);
    const ManylightsView view = make_view();
    EXPECT_EQ(builder.plan({&view, 1}, manylights::make_lights(spheres), sizes).report.status,
              MANYLIGHTS_INVALID_ARGUMENT);
    ASSERT_TRUE(builder.create());
    ASSERT_TRUE(builder.plan({&view, 1}, manylights::make_lights(spheres), sizes));
    Builder moved = std::move(builder);
    Frame frame;
    frame.allocate(sizes);
    ASSERT_TRUE(moved.write(frame.buffers()));
    ASSERT_TRUE(moved.validate(frame.buffers(), sizes, 100));
    std::span<const std::uint32_t> indices;
    ASSERT_TRUE(moved.visible(0, indices));
    EXPECT_EQ(indices.size(), moved.stats().visible_lights);
    const Status failure = moved.visible(1, indices);
    EXPECT_FALSE(failure);
    EXPECT_STREQ(failure.name(), "MANYLIGHTS_INVALID_ARGUMENT");
    EXPECT_TRUE(indices.empty());

    ManylightsSettings bad = make_settings();
    bad.tile_px = 1;
    EXPECT_FALSE(moved.create(bad));
    EXPECT_FALSE(static_cast<bool>(moved));
}

} // namespace
} // namespace manylights::test
