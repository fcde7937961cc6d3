// Z-bins: what is special about them. That they find the lights of brute force is tested with all techniques.

#include "lab/scene/error.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "lab/techniques/z_bins/depth_bins.h"
#include "lab/techniques/z_bins/masks_size.h"
#include "reference/oracle/random.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::lab {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

const DepthBins kBins[] = {linear_bins(1024, 500.0f),    linear_bins(8192, 3500.0f),    linear_bins(8192, 1e-3f),
                           log_bins(1024, 0.1f, 500.0f), log_bins(8192, 0.1f, 3500.0f), log_bins(4096, 2.0f, 1.0f)};

TEST(DepthBins, never_descend_with_the_depth) {
    oracle::Random random(9);
    for (const DepthBins& bins : kBins) {
        for (int i = 0; i < 20000; ++i) {
            const float depth = static_cast<float>(random.octaves(-12, 14));
            const float next = std::nextafter(depth, kInfinity),
                        further = static_cast<float>(depth * random.between(1, 2));
            EXPECT_LE(bin_of(bins, depth), bin_of(bins, next)) << depth;
            EXPECT_LE(bin_of(bins, depth), bin_of(bins, further)) << depth;
            EXPECT_LT(bin_of(bins, depth), bins.count);
        }
    }
}

TEST(DepthBins, begin_at_the_camera_and_the_last_one_is_open) {
    for (const DepthBins& bins : kBins) {
        for (const float depth : {0.0f, -0.0f, -1.0f, -1e18f, -kInfinity}) EXPECT_EQ(bin_of(bins, depth), 0u);
        for (const float depth : {1e18f, 3e38f, kInfinity}) EXPECT_EQ(bin_of(bins, depth), bins.count - 1);
    }
    EXPECT_EQ(bin_of(linear_bins(1024, 512.0f), 100.0f), 200u);
    EXPECT_EQ(bin_of(log_bins(1024, 0.25f, 256.0f), 0.2499f), 0u);
    EXPECT_EQ(bin_of(log_bins(1024, 0.25f, 256.0f), 0.25f), 1u);
    EXPECT_NEAR(bin_of(log_bins(1024, 0.25f, 256.0f), 8.0f), 512, 2) << "half of the octaves";
    EXPECT_GE(bin_of(log_bins(1024, 0.25f, 256.0f), 256.0f), 1022u);
}

TEST(MasksSize, is_refused_beyond_what_a_binding_can_have) {
    EXPECT_EQ(masks_size(1920, 1080, 32, 65536).tiles(), 2040u);
    EXPECT_EQ(masks_size(1920, 1080, 32, 65536).words, 2048u);
    EXPECT_EQ(masks_size(1920, 1080, 32, 65537).words, 2049u);
    EXPECT_EQ(masks_size(1920, 1080, 32, 65537).summary, 65u);
    EXPECT_EQ(masks_size(8192, 8192, 8, 32768).tiles() * 1024, kMostMaskWords);
    try {
        masks_size(8192, 8192, 8, 32769);
        ADD_FAILURE() << "more words than a binding can have were accepted";
    } catch (const InputError& error) {
        for (const char* word : {"z_bins", "tile_size=8", "1048576 tiles", "32769 lights", "1074790400", "1073741824"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

/// All that decides what is looked at, and the loops that look.
std::vector<OptionValues> options() {
    return {{},
            {{"summary", "on"}},
            {{"loop", "wave"}},
            {{"loop", "wave"}, {"summary", "on"}},
            {{"spacing", "log"}, {"sort_key", "near"}, {"tile_size", "8"}}};
}

class ZBinsTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const OptionValues& values, const View& view) {
        std::unique_ptr<Technique> technique = make_technique(device(), "z_bins", values);
        technique->prepare(view.frame());
        return technique;
    }

    void expect_exact(const View& view, const char* what) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        for (const OptionValues& values : options()) {
            const VerifyResult result = compare(truth, prepared(values, view)->record(view.frame()), view.width);
            EXPECT_EQ(result.wrong_pixels, 0u) << what << ", " << ::testing::PrintToString(values);
        }
    }
};

// A point of every depth, and lights that end just in front of or just behind one, in line with the camera, where
// nothing but the depth can leave them out.
TEST_F(ZBinsTest, hold_lights_that_end_at_a_point) {
    View view = made_view(device(), 97, 60, 0);
    add_lights_that_end_at_points(view);
    ASSERT_GT(view.lights.size(), 1000u);
    expect_exact(view, "lights that end at points");
}

TEST_F(ZBinsTest, hold_lights_that_are_everywhere_and_lights_in_one_place) {
    View view = made_view(device(), 97, 60, 1500);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    expect_exact(view, "lights everywhere");
    view = made_view(device(), 97, 60, 1500);
    for (Light& light : view.lights) light.sphere = view.lights.front().sphere;
    expect_exact(view, "all lights at one point");
    view = made_view(device(), 97, 60, 1500);
    for (std::size_t i = 1; i < view.lights.size(); ++i) view.lights[i].sphere.range *= 0.05f;
    view.lights.front().sphere.range = 1e4f;
    expect_exact(view, "a huge light among tiny ones");
    view = made_view(device(), 97, 60, 1500);
    view.positions.assign(view.positions.size(), {glm::vec3(0.0f), 0.0f});
    view.points.positions().upload(view.positions);
    expect_exact(view, "sky everywhere");
}

// Depths beyond the last bin's edge and lights around them.
TEST_F(ZBinsTest, serve_points_beyond_the_view_distance) {
    View view = made_view(device(), 97, 60, 1500);
    view.scene.view_extent = 1.0f;
    expect_exact(view, "all points in the last bin");
    view.scene.view_extent = 1e9f;
    expect_exact(view, "all points in the first bin");
}

// A light that is nearly everywhere makes long ranges, of which tiny lights fill few words.
TEST_F(ZBinsTest, test_the_same_lights_with_a_summary_and_read_fewer_words) {
    View view = made_view(device(), 97, 60, 20000);
    for (Light& light : view.lights) light.sphere.range *= 0.01f;
    view.lights.front().sphere.range = 1e4f;
    const auto work = [&](const char* summary) {
        return summarize(prepared({{"tile_size", "8"}, {"summary", summary}}, view)->record(view.frame()));
    };
    EXPECT_EQ(work("on").tested_mean, work("off").tested_mean);
    EXPECT_LT(work("on").nodes_mean, work("off").nodes_mean);
}

TEST_F(ZBinsTest, test_fewer_lights_with_smaller_tiles_and_more_bins) {
    const View view = made_view(device(), 97, 60, 5000);
    const auto tested = [&](const OptionValues& values) {
        return summarize(prepared(values, view)->record(view.frame())).tested_mean;
    };
    EXPECT_LT(tested({{"tile_size", "8"}}), tested({{"tile_size", "16"}}));
    EXPECT_LT(tested({{"tile_size", "16"}}), tested({{"tile_size", "64"}}));
    EXPECT_LT(tested({{"bins", "8192"}}), tested({{"bins", "1024"}}));
    EXPECT_LT(tested({{"spacing", "log"}}), tested({})) << "most depths are small";
    EXPECT_GE(tested({{"loop", "wave"}}), tested({}));
}

TEST_F(ZBinsTest, differ_by_the_depth_that_lights_are_sorted_by) {
    const View view = made_view(device(), 97, 60, 5000);
    const auto records = [&](const char* key) { return prepared({{"sort_key", key}}, view)->record(view.frame()); };
    EXPECT_EQ(light_set_hash(records("near")), light_set_hash(records("centre")));
    EXPECT_NE(summarize(records("near")).tested_mean, summarize(records("centre")).tested_mean);
}

// A wave of one lane touches what its pixel is said to read.
TEST_F(ZBinsTest, log_what_they_record) {
    View view = made_view(device(), 1, 1, 5000);
    view.lights.front().sphere.range = 1e4f; // so that there are many words to read
    view.positions = {{camera_basis(view.camera, 1, 1).forward * 20.0f, 20.0f}};
    view.points.positions().upload(view.positions);
    std::uint32_t most_nodes = 0;
    for (const OptionValues& values : options()) {
        const std::unique_ptr<Technique> technique = prepared(values, view);
        const PixelRecord record = technique->record(view.frame()).front();
        const WaveSummary waves = technique->waves(view.frame());
        most_nodes = std::max(most_nodes, record.nodes);
        for (const WaveWork& work : {waves.lanes_64, waves.lanes_32}) {
            EXPECT_EQ(work.tested, record.tested) << ::testing::PrintToString(values);
            EXPECT_EQ(work.nodes, record.nodes) << ::testing::PrintToString(values);
        }
    }
    EXPECT_GT(most_nodes, 4u);
}

// Together they look at all ranks between the lowest and the highest of any lane; halves of a wave at fewer.
TEST_F(ZBinsTest, walk_the_ranks_of_all_lanes_with_the_loop_of_waves) {
    const View view = made_view(device(), 97, 60, 5000);
    const WaveSummary lane = prepared({}, view)->waves(view.frame());
    const WaveSummary wave = prepared({{"loop", "wave"}}, view)->waves(view.frame());
    EXPECT_GT(wave.lanes_64.tested, lane.lanes_64.tested);
    EXPECT_EQ(wave.lanes_64.affecting, lane.lanes_64.affecting);
    const auto mean = [](const WaveWork& work) { return double(work.tested) / double(work.waves); };
    EXPECT_LT(mean(wave.lanes_32), mean(wave.lanes_64));
}

TEST_F(ZBinsTest, say_what_they_hold) {
    const View view = made_view(device(), 97, 60, 3000);
    const auto bytes = [&](const OptionValues& values) { return prepared(values, view)->stats().structure_bytes; };
    const TechniqueStats stats = prepared({}, view)->stats();
    EXPECT_GT(stats.references, 3000u);
    EXPECT_EQ(stats.build_ms.size(), 1u);
    const std::uint64_t lights = stats.visible_lights, tiles = 4 * 2;
    EXPECT_EQ(bytes({}), 32 + 8 * 8192 + 4 * lights + 4 * tiles * ((lights + 31) / 32));
    EXPECT_EQ(bytes({{"bins", "1024"}}), bytes({}) - 8 * 7168);
    EXPECT_EQ(bytes({{"summary", "on"}}), bytes({}) + 4 * tiles * ((lights + 1023) / 1024));
}

} // namespace
} // namespace manylights::lab
