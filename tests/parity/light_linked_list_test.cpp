// Light linked lists: what is special about them. That they find the lights of brute force is tested with all
// techniques.

#include "lab/scene/error.h"
#include "lab/techniques/light_linked_list/half_depths.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "reference/oracle/random.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::lab {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Depths next to halves, and everywhere.
std::vector<float> depths() {
    std::vector<float> found{0.0f,     1e-30f,   5.9e-8f,  6.103515625e-5f, 6.104e-5f, 1.0f,     65503.99f,
                             65504.0f, 65504.1f, 65535.9f, 65536.0f,        1e30f,     kInfinity};
    oracle::Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const auto depth = static_cast<float>(random.octaves(-16, 18));
        const float half = depth_of_half(half_below(depth));
        found.insert(found.end(), {depth, half, std::nextafter(half, 0.0f), std::nextafter(half, kInfinity)});
    }
    return found;
}

TEST(HalfDepths, enclose_every_depth_and_are_next_to_each_other) {
    for (const float depth : depths()) {
        const MlUint below = half_below(depth), above = half_above(depth);
        EXPECT_LE(depth_of_half(below), depth);
        EXPECT_GE(depth_of_half(above), depth);
        const bool is_tiny = depth < 6.103515625e-5f; // there, 0 and the least half with all its bits are next
        EXPECT_LE(above, is_tiny ? kHalfLeast : below + 1) << depth;
        if (!is_tiny && depth < 65504.0f && depth_of_half(below) == depth) {
            EXPECT_EQ(above, below) << depth;
        }
    }
    EXPECT_EQ(depth_of_half(0x3C00), 1.0f);
    EXPECT_EQ(depth_of_half(0x4248), 3.140625f);
    EXPECT_EQ(half_below(65505.0f), 0x7BFFu);
    EXPECT_EQ(depth_of_half(half_above(65505.0f)), kInfinity);
}

TEST(HalfDepths, never_descend) {
    std::vector<float> sorted = depths();
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        for (MlUint (*half_of)(float) : {half_below, half_above, half_nearest})
            EXPECT_LE(half_of(sorted[i - 1]), half_of(sorted[i])) << sorted[i];
}

TEST(HalfDepths, nearest_is_one_of_the_two_and_loses_depths) {
    int lost = 0;
    for (const float depth : depths()) {
        const MlUint nearest = half_nearest(depth);
        if (depth >= 6.103515625e-5f && depth < 65504.0f) {
            EXPECT_GE(nearest, half_below(depth));
            EXPECT_LE(nearest, half_above(depth));
        }
        lost += depth_of_half(nearest) < depth;
    }
    EXPECT_GT(lost, 1000);
}

/// All that decides what is entered and where it is read.
std::vector<OptionValues> options() {
    return {{},
            {{"resolution", "quarter"}, {"link_bytes", "16"}},
            {{"resolution", "full"}, {"link_bytes", "12"}},
            {{"depth_test", "off"}, {"first_links", "0"}}};
}

class LightLinkedListTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const OptionValues& values, const View& view) {
        std::unique_ptr<Technique> technique = make_technique(device(), "light_linked_list", values);
        technique->prepare(view.frame());
        return technique;
    }

    VerifyResult verified(const OptionValues& values, const View& view) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        return compare(truth, prepared(values, view)->record(view.frame()), view.width);
    }

    void expect_exact(const View& view, const char* what) {
        for (const OptionValues& values : options())
            EXPECT_EQ(verified(values, view).wrong_pixels, 0u) << what << ", " << ::testing::PrintToString(values);
    }

    // Lights that end just in front of or just behind a point, in line with the camera.
    View view_with_ends(std::uint32_t width, std::uint32_t height) {
        View view = made_view(device(), width, height, 0);
        const glm::vec3 forward = camera_basis(view.camera, view.width, view.height).forward;
        oracle::Random random(4);
        for (const PointPosition& point : view.positions) {
            if (point.depth == 0.0f || !random.chance(0.25)) continue;
            const auto range = static_cast<float>(0.5 * point.depth * random.unit());
            const float side = random.chance(0.5) ? 1.0f : -1.0f;
            const glm::vec3 center = view.camera.position + point.position + forward * (side * range * 0.9999999f);
            view.lights.push_back({{{center.x, center.y, center.z}, range}, {1, 1, 1}});
        }
        return view;
    }
};

TEST_F(LightLinkedListTest, hold_lights_that_end_at_a_point) {
    const View view = view_with_ends(97, 60);
    ASSERT_GT(view.lights.size(), 1000u);
    expect_exact(view, "lights that end at points");
}

TEST_F(LightLinkedListTest, hold_lights_that_are_everywhere_and_lights_in_one_place) {
    View view = made_view(device(), 97, 60, 300);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    expect_exact(view, "lights everywhere");
    view = made_view(device(), 97, 60, 300);
    for (Light& light : view.lights) light.sphere = view.lights.front().sphere;
    expect_exact(view, "all lights at one point");
    view.positions.assign(view.positions.size(), {glm::vec3(0.0f), 0.0f});
    view.points.positions().upload(view.positions);
    expect_exact(view, "sky everywhere");
}

// Links of 8 bytes have 8 bits for a light: with the 257th they become 12 bytes, and no light is taken for another.
TEST_F(LightLinkedListTest, widen_links_beyond_256_lights) {
    for (const std::uint32_t count : {255u, 256u, 257u}) {
        View view = made_view(device(), 97, 60, count);
        for (Light& light : view.lights) light.sphere.range = 30.0f;
        EXPECT_EQ(verified({}, view).wrong_pixels, 0u) << count;
        const auto stats = [&](const char* bytes) { return prepared({{"link_bytes", bytes}}, view)->stats(); };
        const TechniqueStats eight = stats("8"), twelve = stats("12");
        const bool is_short = eight.visible_lights <= 256;
        EXPECT_EQ(eight.structure_bytes,
                  twelve.structure_bytes - (is_short ? 4 * eight.references - 32 * eight.visible_lights : 0));
    }
    View view = made_view(device(), 97, 60, 257);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    ASSERT_EQ(prepared({}, view)->stats().visible_lights, 257u);
    EXPECT_EQ(verified({}, view).wrong_pixels, 0u);
}

// A pool that is too small is made as large as it has to be, and the lists are what they would have been at once.
TEST_F(LightLinkedListTest, grow_their_pool_and_lose_nothing) {
    const View small = made_view(device(), 97, 60, 40), large = made_view(device(), 97, 60, 3000);
    for (const char* bytes : {"8", "16"}) {
        const std::unique_ptr<Technique> technique =
            make_technique(device(), "light_linked_list", {{"first_links", "0"}, {"link_bytes", bytes}});
        for (const View* view : {&small, &large, &small}) {
            technique->prepare(view->frame());
            EXPECT_EQ(
                compare(records_of(device(), kBruteForce, view->frame()), technique->record(view->frame()), view->width)
                    .wrong_pixels,
                0u);
            EXPECT_EQ(technique->stats().references,
                      prepared({{"first_links", "256"}, {"link_bytes", bytes}}, *view)->stats().references);
        }
    }
}

TEST_F(LightLinkedListTest, name_links_that_no_pool_can_hold) {
    View view = made_view(device(), 761, 700, 130);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    try {
        prepared({{"resolution", "full"}, {"depth_test", "off"}}, view);
        ADD_FAILURE() << "more links than a pool holds were accepted";
    } catch (const InputError& error) {
        for (const char* word : {"light_linked_list", "69251000 links", "67108864", "resolution=eighth"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

// More links than one buffer of the pool has, and than 24 bits number.
TEST_F(LightLinkedListTest, hold_links_in_several_buffers) {
    View view = made_view(device(), 512, 400, 100);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    for (const char* bytes : {"8", "16"}) {
        const OptionValues values{{"resolution", "full"}, {"depth_test", "off"}, {"link_bytes", bytes}};
        const std::unique_ptr<Technique> technique = prepared(values, view);
        EXPECT_EQ(technique->stats().references, 512u * 400 * 100);
        EXPECT_EQ(technique->stats().structure_bytes / technique->stats().references, bytes[0] == '8' ? 12u : 16u);
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        EXPECT_EQ(compare(truth, technique->record(view.frame()), view.width).wrong_pixels, 0u);
    }
}

// The lists of a view serve points that lie in front of its opaque surface; without the test of depths, behind it too.
TEST_F(LightLinkedListTest, serve_points_in_front_of_the_surface) {
    View view = made_view(device(), 97, 60, 3000);
    const std::vector<PointPosition> surface = view.positions;
    oracle::Random random(8);
    for (const OptionValues& values : options()) {
        const bool is_tested = values.empty() || values.front().first != "depth_test";
        view.points.positions().upload(surface);
        const std::unique_ptr<Technique> technique = prepared(values, view);
        std::vector<PointPosition> points = surface;
        for (PointPosition& point : points) {
            const auto scale = static_cast<float>(is_tested ? random.unit() : random.octaves(-3, 3));
            const float nearer = std::max(scale, 0.11f / std::max(point.depth, 0.11f));
            point.position *= nearer;
            point.depth *= nearer;
        }
        view.points.positions().upload(points);
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        const VerifyResult result = compare(truth, technique->record(view.frame()), view.width);
        EXPECT_EQ(result.wrong_pixels, 0u) << ::testing::PrintToString(values);
        EXPECT_GT(result.shaded, 4000u);
    }
}

// Where a texel holds sky, nothing behind its nearer points is hidden.
TEST_F(LightLinkedListTest, keep_lights_in_the_sky_of_a_texel) {
    const View view = made_view(device(), 97, 60, 3000);
    const TechniqueStats tested = prepared({}, view)->stats();
    EXPECT_LT(tested.references, prepared({{"depth_test", "off"}}, view)->stats().references);
    View sky = made_view(device(), 97, 60, 3000);
    sky.positions.assign(sky.positions.size(), {glm::vec3(0.0f), 0.0f});
    sky.points.positions().upload(sky.positions);
    EXPECT_EQ(prepared({}, sky)->stats().references, prepared({{"depth_test", "off"}}, sky)->stats().references);
}

// What is known to be wrong is seen to be, and what is said of it.
TEST_F(LightLinkedListTest, lose_lights_in_the_forms_that_are_known_to) {
    const View ends = view_with_ends(97, 60), view = made_view(device(), 97, 60, 3000);
    EXPECT_GT(verified({{"lossy", "rounding"}}, ends).missing_points, 0u);
    for (const char* resolution : {"eighth", "quarter"})
        for (const char* lossy : {"centre", "coverage"})
            EXPECT_GT(verified({{"lossy", lossy}, {"resolution", resolution}}, view).missing_points, 0u) << lossy;
    for (const char* lossy : {"centre", "coverage", "rounding"})
        EXPECT_FALSE(prepared({{"lossy", lossy}}, view)->info().exact) << lossy;
    EXPECT_TRUE(prepared({}, view)->info().exact);
}

TEST_F(LightLinkedListTest, test_fewer_lights_at_higher_resolutions_with_longer_links) {
    const View view = made_view(device(), 97, 60, 5000);
    const auto work = [&](const OptionValues& values) {
        return summarize(prepared(values, view)->record(view.frame()));
    };
    EXPECT_LT(work({{"resolution", "quarter"}}).tested_mean, work({}).tested_mean);
    EXPECT_LT(work({{"resolution", "full"}}).tested_mean, work({{"resolution", "quarter"}}).tested_mean);
    EXPECT_LT(work({{"link_bytes", "16"}}).tested_mean, work({{"link_bytes", "12"}}).tested_mean);
    EXPECT_LT(work({}).references_mean, work({{"depth_test", "off"}}).references_mean);
}

// A wave of one lane touches what its pixel is said to read.
TEST_F(LightLinkedListTest, log_what_they_record) {
    View view = made_view(device(), 1, 1, 5000);
    view.positions = {{camera_basis(view.camera, 1, 1).forward * 20.0f, 20.0f}};
    view.points.positions().upload(view.positions);
    for (const OptionValues& values : options()) {
        const std::unique_ptr<Technique> technique = prepared(values, view);
        const PixelRecord record = technique->record(view.frame()).front();
        const WaveSummary waves = technique->waves(view.frame());
        EXPECT_GT(record.references, 0u);
        EXPECT_EQ(technique->references_in_range(view.frame()), double(record.tested));
        for (const WaveWork& work : {waves.lanes_64, waves.lanes_32}) {
            EXPECT_EQ(work.tested, record.tested) << ::testing::PrintToString(values);
            EXPECT_EQ(work.nodes, record.nodes) << ::testing::PrintToString(values);
            EXPECT_EQ(work.checks, record.references) << ::testing::PrintToString(values);
        }
    }
}

} // namespace
} // namespace manylights::lab
