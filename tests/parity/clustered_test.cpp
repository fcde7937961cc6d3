// The options of `clustered` that make it a rival: what they may change, and what they must not.

#include "lab/techniques/summary.h"
#include "tests/parity/techniques_fixture.h"

#include <cstring>

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
    for (const ImageSize size : kSizes)
        for (const std::uint32_t lights : {0u, 1u, 700u})
            for (const char* tile_size : {"8", "11", "48"}) {
                SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height) + ", " +
                             std::to_string(lights) + " lights, tiles of " + tile_size);
                expect_same_pixels(made_view(device(), size.width, size.height, lights),
                                   {{"producer", "paper"}, {"tile_size", tile_size}, {"slice_count", "64"}});
            }
}

// Lanes that have nothing to walk, side by side with ones that have.
TEST_F(Clustered, loop_of_waves_passes_over_sky) {
    View view = made_view(device(), 40, 32, 700);
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel)
        if (pixel % 7 < 3 || pixel / 40 >= 20) view.positions[pixel].depth = 0.0f;
    view.points.positions().upload(view.positions);
    expect_same_pixels(view, {{"cell_test", "tight"}});
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
