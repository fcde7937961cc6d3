// The options of `clustered` that make it a rival: what they may change, and what they must not.

#include "lab/techniques/host_structure.h"
#include "lab/techniques/producer.h"
#include "lab/techniques/shading_pass.h"
#include "lab/techniques/summary.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

namespace manylights::lab {

namespace {

struct ImageSize {
    std::uint32_t width, height;
};
// One lane, waves cut by the image's edges, whole waves.
constexpr ImageSize kSizes[] = {{1, 1}, {7, 3}, {47, 33}, {64, 48}, {97, 60}};

OptionValues with(OptionValues options, const char* key, const char* value) {
    options.emplace_back(key, value);
    return options;
}

constexpr std::uint32_t kStepsCode[] =
#include "wave_loop_steps.comp.inc"
    ;

struct Query {
    const HostStructure& structure;
#define ML_SLICE_EDGE(i) structure.slice_edges[i]
#define ML_CELL(i) structure.cells[i]
#define ML_NODE(i) structure.nodes[i]
#define ML_REFERENCE(i) structure.references[i]
#include <manylights/query.h>
};

void add_list(const View& view, const HostStructure& structure, std::size_t pixel, std::set<MlUint>& lights) {
    Query query{structure};
    const MlFloat2 center{static_cast<float>(pixel % view.width) + 0.5f, static_cast<float>(pixel / view.width) + 0.5f};
    Query::MlCursor cursor = query.ml_begin(structure.view, center, view.positions[pixel].depth);
    MlUint light = 0;
    while (query.ml_next(cursor, light)) lights.insert(light);
}

/// Of a wave: the lights of its lanes' lists, and the most that any of its lanes saw loaded.
struct WaveSteps {
    std::set<MlUint> lights;
    std::uint32_t steps = 0;
};

class Clustered : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const View& view, const OptionValues& options) {
        std::unique_ptr<Technique> technique = make_technique(device(), "clustered", options);
        technique->prepare(view.frame());
        return technique;
    }

    // The loops differ in who loads a light, in nothing that a pixel finds, counts or adds up.
    void expect_same_pixels(const View& view, const OptionValues& options) {
        const std::unique_ptr<Technique> lane = prepared(view, with(options, "loop", "lane"));
        const std::unique_ptr<Technique> wave = prepared(view, with(options, "loop", "wave"));
        const std::vector<PixelRecord> records = lane->record(view.frame());
        ASSERT_EQ(records.size(), std::size_t{view.width} * view.height);
        EXPECT_EQ(std::memcmp(records.data(), wave->record(view.frame()).data(), records.size() * sizeof(PixelRecord)),
                  0);
        EXPECT_EQ(lane->shade(view.frame()), wave->shade(view.frame()));
        EXPECT_EQ(lane->waves(view.frame()), wave->waves(view.frame()));
    }
};

} // namespace

TEST_F(Clustered, loop_of_waves_gives_the_pixels_of_the_loop_of_lanes) {
    const auto check = [this](ImageSize size, std::uint32_t lights, const char* tile_size) {
        SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height) + ", " + std::to_string(lights) +
                     " lights, tiles of " + tile_size);
        expect_same_pixels(made_view(device(), size.width, size.height, lights),
                           {{"producer", "paper"}, {"tile_size", tile_size}, {"slice_count", "64"}});
    };
    for (const ImageSize size : kSizes)
        for (const char* tile_size : {"11", "48"}) check(size, 700, tile_size);
    for (const std::uint32_t lights : {0u, 1u}) check({47, 33}, lights, "8");
}

// Lanes that have nothing to walk, side by side with ones that have.
TEST_F(Clustered, loop_of_waves_passes_over_sky) {
    View view = made_view(device(), 40, 32, 700);
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel)
        if (pixel % 7 < 3 || pixel / 40 >= 20) view.positions[pixel].depth = 0.0f;
    view.points.positions().upload(view.positions);
    expect_same_pixels(view, {{"cell_test", "tight"}});
}

// Each light of the lanes' lists is loaded once for all of them: what the modelled waves count. Waves of the software
// driver are so many pixels of a block of 8 x 8 pixels, row by row. The shader itself says how many: its cache on the
// disk may hold code for another width than the device has now.
TEST_F(Clustered, loop_of_waves_loads_each_light_once) {
    if (!device().info().is_software) GTEST_SKIP() << "which pixels share a wave is known of the software driver only";
    const View view = made_view(device(), 97, 60, 700);
    StructureOptions options;
    options.kind = StructureKind::lists;
    options.tile_size = 11; // so that tiles end inside of waves
    options.cell_test = paper::CellTest::tight;
    const std::unique_ptr<Producer> producer = make_paper_producer(options);
    StructureBuffers buffers(device());
    buffers.reserve(producer->plan(view.frame()));
    producer->write(buffers.targets());
    buffers.finish();
    ShadingPass pass(device(), {"steps", kStepsCode, kStepsCode, kStepsCode, 5}, LightSplit::none);
    const std::vector<PixelRecord> records =
        pass.record(view.frame(), FrameLights(device(), view.frame()), one_band(view.frame(), buffers.bindings()));
    const HostStructure structure(buffers.bindings());
    std::map<std::size_t, WaveSteps> waves;
    for (std::size_t pixel = 0; pixel < records.size(); ++pixel) {
        if (view.positions[pixel].depth == 0.0f) continue;
        const std::size_t x = pixel % view.width, y = pixel / view.width;
        const std::size_t block = y / 8 * ((view.width + 7) / 8) + x / 8;
        WaveSteps& wave = waves[(block * 64 + y % 8 * 8 + x % 8) / records[pixel].references];
        add_list(view, structure, pixel, wave.lights);
        wave.steps = std::max(wave.steps, records[pixel].nodes);
    }
    for (const auto& [number, wave] : waves) EXPECT_EQ(wave.steps, wave.lights.size()) << "wave " << number;
}

// A light's index replaced by a greater one: the list no longer ascends, and no other light of it is lost.
TEST_F(Clustered, loop_of_waves_does_not_rely_on_the_order) {
    const View view = made_view(device(), 97, 60, 700);
    const std::unique_ptr<Technique> lane = prepared(view, {{"producer", "paper"}});
    const std::unique_ptr<Technique> wave = prepared(view, {{"loop", "wave"}});
    ASSERT_TRUE(lane->remove_one_reference(view.frame()));
    ASSERT_TRUE(wave->remove_one_reference(view.frame()));
    const std::vector<PixelRecord> records = lane->record(view.frame());
    EXPECT_EQ(std::memcmp(records.data(), wave->record(view.frame()).data(), records.size() * sizeof(PixelRecord)), 0);
}

TEST_F(Clustered, tight_cells_hold_fewer_lights_and_test_fewer) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* slices : {"16", "128"}) {
        const OptionValues options{{"producer", "paper"}, {"tile_size", "16"}, {"slice_count", slices}};
        const std::unique_ptr<Technique> box = prepared(view, options);
        const std::unique_ptr<Technique> tight = prepared(view, with(options, "cell_test", "tight"));
        EXPECT_LT(tight->stats().references, box->stats().references);
        const WorkSummary box_work = summarize(box->record(view.frame())),
                          tight_work = summarize(tight->record(view.frame()));
        EXPECT_LT(tight_work.tested_mean, box_work.tested_mean);
        EXPECT_EQ(tight_work.affecting_mean, box_work.affecting_mean);
    }
}

} // namespace manylights::lab
