// Depth windows on their own: the scale of depth codes, the cut of a tile, and which tile sizes are chosen.

#include "src/build/record_stages.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace manylights::test {
namespace {

using namespace detail;

float scale_for(const std::vector<float>& near_ends) {
    std::uint32_t exponents[256] = {};
    for (const float depth : near_ends) ++exponents[depth > 0.0f ? std::bit_cast<std::uint32_t>(depth) >> 23 : 0];
    return choose_depth_scale(exponents);
}

TEST(DepthScale, GivesNearlyAllNearEndsCodesBelow18Bits) {
    EXPECT_EQ(scale_for({1.0f}), 0x1p17f);
    EXPECT_EQ(scale_for({1.999f, -5.0f, 0.0f}), 0x1p17f);
    EXPECT_EQ(scale_for({2.0f, 1.0f}), 0x1p16f);
    EXPECT_EQ(scale_for({500.0f}), 0x1p9f);
    std::vector<float> near_ends(2048, 100.0f);
    EXPECT_EQ(scale_for(near_ends), 0x1p11f);
    near_ends[0] = near_ends[1] = 1e30f;
    EXPECT_EQ(scale_for(near_ends), 0x1p11f) << "2 of 2,048 may saturate";
    near_ends[2] = 1000.0f;
    EXPECT_EQ(scale_for(near_ends), 0x1p8f) << "3 may not";
}

TEST(DepthScale, IsAPlainPowerOfTwoForEveryDepth) {
    for (const float depth : {0.0f, 1e-45f, 1e-38f, 1e-20f, 1e20f, 3.4e38f, -3.4e38f, -INFINITY}) {
        const float scale = scale_for({depth});
        EXPECT_EQ(std::bit_cast<std::uint32_t>(scale) & 0x807FFFFFu, 0u) << depth;
        EXPECT_GE(scale, 0x1p-126f);
        EXPECT_LE(scale, 0x1p126f);
        EXPECT_LT(ml_depth_code(depth, scale), 1u << 18) << depth;
    }
    EXPECT_LE(scale_for({}), 0x1p126f);
}

// Records whose extents have between low_bits and high_bits bits.
std::vector<TileRecord> random_records(Random& random, std::uint32_t count, std::uint32_t span, int low_bits,
                                       int high_bits) {
    std::vector<TileRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto near_code = static_cast<std::uint32_t>(random.bits() % span);
        const auto bits = low_bits + static_cast<int>(random.bits() % static_cast<unsigned>(high_bits - low_bits + 1));
        const auto extent = static_cast<std::uint32_t>(random.bits() % (std::uint64_t{1} << bits));
        records[i] = {i, near_code, std::min(near_code + extent, ML_DEPTH_CODE_MAX)};
    }
    return records;
}

// A tile as plan makes it.
struct MadeTile {
    WindowTile tile;
    std::vector<WindowReference> ordered;
    std::vector<MlCell> entries;

    MlWindow window(std::uint32_t slice) const {
        if (tile.form.flat_count != 0) return {0, tile.count, tile.count, tile.count};
        const MlUint at = ml_entry_cell(tile.form, slice);
        return ml_window_from_cells(tile.form, slice, entries[at],
                                    entries[std::min<std::size_t>(at + 1, entries.size() - 1)]);
    }
};

// In runs of awkward lengths.
MadeTile make_tile(std::vector<TileRecord> records) {
    const auto count = static_cast<std::uint32_t>(records.size());
    const std::size_t room = count + kLanePadding;
    records.resize(room);
    std::vector<std::uint32_t> words(2 * room);
    std::vector<WindowReference> references(2 * room);
    std::vector<MlCell> entries(kMostEntryWords / 2, {77, 77});
    std::vector<RecordRun> runs;
    for (std::uint32_t at = 0; at < count; at += runs.back().count)
        runs.push_back({records.data() + at, std::min(1 + at % 21, count - at)});
    const TileRuns all = {runs.data(), static_cast<std::uint32_t>(runs.size())};
    const TileScratch scratch = {nullptr,
                                 words.data(),
                                 words.data() + room,
                                 references.data(),
                                 references.data() + room,
                                 reinterpret_cast<MlUint*>(entries.data())};
    MadeTile made;
    made.tile = measure_tile(all, count, scratch);
    const WindowReference* const ordered = order_tile(made.tile, all, scratch);
    made.ordered.assign(ordered, ordered + count);
    made.entries.assign(entries.begin(), entries.begin() + ml_entry_cell_count(made.tile.form));
    const bool has_odd_word = made.tile.form.two_classes + made.tile.form.wide + made.tile.form.last_slice % 2 == 0;
    if (has_odd_word && !made.entries.empty()) {
        EXPECT_EQ(made.entries.back().count, 0u) << "behind the last entry";
    }
    return made;
}

// What the layout demands of a form, whatever the records are.
void expect_sound(const MadeTile& made, const std::vector<TileRecord>& records) {
    const WindowTile& tile = made.tile;
    const auto count = static_cast<std::uint32_t>(records.size());
    EXPECT_NE(ml_pack_tile_form(tile.form), 0u);
    EXPECT_LT(tile.form.last_slice, ML_TILE_SLICES_MAX);
    EXPECT_EQ(tile.form.wide, count > 65535 ? 1u : 0u);
    EXPECT_EQ(tile.form.two_classes, tile.small_count < count ? 1u : 0u);
    EXPECT_TRUE(tile.form.flat_count == 0 || tile.form.flat_count == count);
    std::vector<bool> seen(count, false);
    for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_FALSE(seen[made.ordered[i].light]);
        seen[made.ordered[i].light] = true;
        const TileRecord& record = records[made.ordered[i].light];
        ASSERT_GE(record.near_code(), tile.base_code);
        ASSERT_LE(slice_of_code(tile, record.far_code()), tile.form.last_slice);
        const bool has_one_before = i != 0 && i != tile.small_count;
        ASSERT_TRUE(!has_one_before || slice_of_code(tile, records[made.ordered[i - 1].light].near_code()) <=
                                           slice_of_code(tile, record.near_code()));
        const bool small = i < tile.small_count;
        ASSERT_EQ(small, record.extent() < 1u << tile.small_bits);
        for (std::uint32_t s = slice_of_code(tile, record.near_code()); s <= slice_of_code(tile, record.far_code());
             ++s) {
            const MlWindow window = made.window(s);
            ASSERT_TRUE(small ? window.small_first <= i && i < window.small_last
                              : window.large_first <= i && i < window.large_last);
        }
        const std::uint32_t shift = small ? tile.form.small_shift : tile.form.large_shift;
        ASSERT_EQ(made.ordered[i].bounds & 255u, (record.near_code() >> shift) & 255u);
        ASSERT_EQ((made.ordered[i].bounds >> 8) & 255u, (record.far_code() >> shift) - (record.near_code() >> shift));
        // From any depth of the record's window, no unit of the 256 is met twice.
        const std::uint32_t slice = 1u << tile.form.slice_shift;
        ASSERT_LE((record.extent() >> shift) + 1 + ((2 * slice) >> shift), 255u);
    }
}

TEST(MakeTile, KeepsEveryRecordOnceInOrderAndInBounds) {
    Random random(5);
    int two_classes = 0;
    for (const std::uint32_t count : {1u, 2u, 8u, 9u, 17u, 127u, 128u, 1000u, 65535u, 65536u}) {
        for (const std::uint32_t span : {1u, 2u, 300u, 1u << 18, 1u << 24}) {
            for (const int high_bits : {0, 4, 12, 24}) {
                const auto records = random_records(random, count, span, 0, high_bits);
                const MadeTile made = make_tile(records);
                expect_sound(made, records);
                ASSERT_FALSE(HasFailure()) << count << " records, span " << span << ", bits " << high_bits;
                two_classes += made.tile.form.two_classes != 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(two_classes, 30);
}

TEST(MakeTile, SplitsClassesAndSlicesWhereThatSavesChecks) {
    Random random(6);
    const auto cut = [&](std::uint32_t count, std::uint32_t large_count) {
        auto records = random_records(random, count, 1u << 16, 6, 6);
        for (std::uint32_t i = 0; i < large_count; ++i) records[i].far_bits = records[i].near_bits + (1u << 15);
        return make_tile(records);
    };
    const WindowTile flat = cut(8, 1).tile;
    EXPECT_EQ(flat.form.flat_count, 8u);
    EXPECT_EQ(ml_entry_cell_count(flat.form), 0u);
    const WindowTile one_class = cut(200, 0).tile;
    EXPECT_EQ(one_class.form.two_classes, 0u);
    EXPECT_GE(one_class.form.last_slice + 1, 128u);
    EXPECT_LE(one_class.form.last_slice + 1, ML_TILE_SLICES_MAX);
    const WindowTile few = cut(20, 0).tile;
    EXPECT_GE(few.form.last_slice + 1, 15u) << "half of 3/2 of the references at least";
    EXPECT_LE(few.form.last_slice + 1, 30u);
    const MadeTile split = cut(200, 20);
    EXPECT_EQ(split.tile.form.two_classes, 1u);
    EXPECT_EQ(split.tile.small_count, 180u);
    EXPECT_LT(split.tile.form.small_shift, split.tile.form.large_shift);
    EXPECT_EQ(cut(200, 200).tile.form.two_classes, 0u);
    const WindowTile many = cut(5000, 0).tile;
    EXPECT_GE(many.form.last_slice + 1, 128u);
}

struct FoundRecord {
    TileRecord record;
    std::uint32_t tile;
};

std::vector<FoundRecord> records_of(ManylightsBuilder& builder) {
    std::vector<FoundRecord> found;
    std::vector<RecordRun> room(run_room(builder.records, builder.windows.largest_tile));
    for (std::uint32_t t = 0; t < builder.windows.tiles.size(); ++t) {
        const TileRuns runs = list_runs(builder.records, t, room.data());
        for (std::uint32_t k = 0; k < runs.count; ++k)
            for (std::uint32_t i = 0; i < room[k].count; ++i) found.push_back({room[k].records[i], t});
    }
    return found;
}

// Every reference of a frame, asked for by the shader's own query at the ends of its range, in its corner steps.
TEST(Windows, HandOutEachReferenceFromItsFirstDepthCodeToItsLast) {
    ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_WINDOWS);
    for (const std::uint32_t tile_px : {8u, 32u, 48u, 4096u}) {
        settings.tile_px = tile_px;
        const BuilderPtr builder = make_builder(settings);
        const auto spheres = make_lights(3000, tile_px, 60.0, 0.2, 12.0);
        const Frame frame = build_frame(builder.get(), {make_view()}, spheres);
        const MlView& view = frame.views[0];
        const std::vector<FoundRecord> found = records_of(*builder);
        ASSERT_GT(found.size(), 500u);
        std::uint64_t codes = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const TileRecord& record = found[i].record;
            const auto pixel = [&](std::uint32_t tile, std::uint32_t step, std::uint32_t size) {
                const std::uint32_t px = tile * tile_px + (step * tile_px + ML_TILE_STEPS - 1) / ML_TILE_STEPS;
                return static_cast<float>(std::min(px, size - 1)) + 0.5f;
            };
            const float x = pixel(found[i].tile % view.tiles_x, record.near_bits >> 28, view.width);
            const float y = pixel(found[i].tile / view.tiles_x, (record.far_bits >> 24) & 15, view.height);
            for (const std::uint32_t code : {record.near_code(), record.far_code()}) {
                if (code == ML_DEPTH_CODE_MAX) continue;
                const auto lights = lights_at(frame, 0, x, y, static_cast<float>(code) / view.depth_scale);
                ASSERT_EQ(std::count(lights.begin(), lights.end(), record.light), 1) << tile_px << " " << i;
                ++codes;
            }
        }
        EXPECT_GT(codes, 1000u);
    }
}

// The radius's own slack is about as large: only the codes tell whether both were added.
TEST(Windows, WidenDepthsByWhatACallersMayBeOff) {
    std::vector<ManylightsSphere> spheres;
    for (int i = 0; i < 1000; ++i) spheres.push_back({{0.0f, 0.0f, -400.0f - 0.1f * static_cast<float>(i)}, 1.0f});
    const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_WINDOWS));
    const Frame frame = build_frame(builder.get(), {make_view()}, spheres);
    const auto code = [&](double depth) {
        return static_cast<std::uint32_t>(depth * static_cast<double>(frame.views[0].depth_scale));
    };
    int narrow = 0;
    for (const auto& [record, tile] : records_of(*builder)) {
        const double depth = -static_cast<double>(spheres[record.light].center[2]);
        const double radius = culling_radius(1.0, 0.0, depth, depth, 0.0);
        ASSERT_LE(record.near_code(), code((depth - radius) * (1.0 - 0x1p-20)));
        ASSERT_GE(record.far_code(), code((depth + radius) * (1.0 + 0x1p-20)));
        narrow += record.near_code() < code(depth - radius) || record.far_code() > code(depth + radius) ? 1 : 0;
    }
    EXPECT_GT(narrow, 100);
}

std::uint32_t chosen_tile_px(const std::vector<ManylightsSphere>& spheres, std::uint32_t tile_px,
                             std::uint64_t max_bytes = 0) {
    ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_WINDOWS);
    settings.tile_px = tile_px;
    settings.max_bytes = max_bytes;
    const BuilderPtr builder = make_builder(settings);
    const ManylightsView view = make_view();
    const ManylightsLights lights = lights_of(spheres);
    ManylightsSizes sizes{};
    EXPECT_EQ(manylights_plan(builder.get(), &view, 1, &lights, &sizes, nullptr), MANYLIGHTS_OK);
    ManylightsStats stats{};
    manylights_stats(builder.get(), &stats);
    EXPECT_EQ(stats.over_budget, 0u);
    return stats.tile_px;
}

TEST(Windows, ChooseTheTileSizeByLightsAndReferences) {
    EXPECT_EQ(chosen_tile_px({}, 0), 32u);
    EXPECT_EQ(chosen_tile_px(make_lights(2000, 1, 40.0, 0.1, 1.0), 0), 32u);
    // The image has 10 x 6 tiles of 32 pixels, 5 x 3 of 64 and 3 x 2 of 128: lights that fill it pass 12 twice.
    const auto everywhere = make_lights(50, 1, 1.0, 500.0, 600.0);
    EXPECT_EQ(chosen_tile_px(everywhere, 0), 128u);
    EXPECT_EQ(chosen_tile_px(everywhere, 32), 32u) << "the caller's size stays";
    EXPECT_EQ(chosen_tile_px(everywhere, 32, 64 + 3000 * 8), 64u) << "but for the budget";

    std::vector<ManylightsSphere> very_many(500000, {{0.0f, 0.0f, -30.0f}, 0.1f});
    EXPECT_EQ(chosen_tile_px(very_many, 0), 24u);
    very_many.pop_back();
    EXPECT_EQ(chosen_tile_px(very_many, 0), 32u);
}

TEST(Windows, LeaveSlicesAndNodesEmptyAndCountTiles) {
    const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_WINDOWS));
    const Frame frame = build_frame(builder.get(), {make_view()}, make_lights(3000, 1, 40.0, 0.1, 3.0));
    EXPECT_EQ(frame.sizes.slice_edges, 0u);
    EXPECT_EQ(frame.sizes.nodes, 0u);
    EXPECT_EQ(frame.views[0].slice_count, 0u);
    ManylightsStats stats{};
    manylights_stats(builder.get(), &stats);
    EXPECT_EQ(stats.cells, 60u);
    EXPECT_EQ(stats.references * 8, frame.sizes.references);
    EXPECT_EQ(stats.nodes, 0u);
    EXPECT_EQ(stats.empty_cells + stats.list_cells + stats.tree_cells, 60u);
    EXPECT_GT(stats.tree_cells, 0u);
}

} // namespace
} // namespace manylights::test
