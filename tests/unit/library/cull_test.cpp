// Which lights are in view, and which are ignored by a written rule.

#include "src/build/cull.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Culled {
    std::vector<std::uint32_t> visible;
    ManylightsStats stats;
};

Culled cull(const std::vector<ManylightsSphere>& spheres, const ManylightsView& view = make_view(),
            float motion_margin = 0.0f) {
    const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_LISTS));
    ManylightsLights lights = lights_of(spheres);
    lights.motion_margin = motion_margin;
    ManylightsSizes sizes{};
    EXPECT_EQ(manylights_plan(builder.get(), &view, 1, &lights, &sizes, nullptr), MANYLIGHTS_OK);
    const std::uint32_t* indices = nullptr;
    std::uint32_t count = 0;
    EXPECT_EQ(manylights_visible(builder.get(), 0, &indices, &count, nullptr), MANYLIGHTS_OK);
    Culled culled{{indices, indices + count}, {}};
    manylights_stats(builder.get(), &culled.stats);
    return culled;
}

using Indices = std::vector<std::uint32_t>;

// The camera looks along -z, 0.8 up and down, 1.42 to the sides, from 0.1 to 1000.
TEST(Cull, KeepsTheLightsInView) {
    CameraOptions options;
    options.projection = Projection::kReversed;
    const auto seen = [&](float x, float y, float z, float range) {
        return cull({{{x, y, z}, range}}, make_view(options)).visible.size() == 1;
    };
    EXPECT_TRUE(seen(0, 0, -10, 1));
    EXPECT_FALSE(seen(0, 0, 10, 1)) << "behind";
    EXPECT_TRUE(seen(0, 0, 10, 11)) << "behind, and reaches over the camera";
    EXPECT_FALSE(seen(0, 20, -10, 1)) << "above";
    EXPECT_FALSE(seen(0, -20, -10, 1)) << "below";
    EXPECT_FALSE(seen(30, 0, -10, 1)) << "right";
    EXPECT_FALSE(seen(-30, 0, -10, 1)) << "left";
    EXPECT_TRUE(seen(-30, 0, -10, 20));
    EXPECT_FALSE(seen(0, 0, -1020, 5)) << "beyond the far plane";
    EXPECT_TRUE(seen(0, 0, -1020, 21));
    options.projection = Projection::kReversedInfinite;
    EXPECT_TRUE(seen(0, 0, -1e6f, 5));
}

TEST(Cull, GrowsRangesByTheMotionMargin) {
    const std::vector<ManylightsSphere> behind = {{{0, 0, 10}, 1}};
    EXPECT_EQ(cull(behind, make_view(), 0.0f).visible, Indices{});
    EXPECT_EQ(cull(behind, make_view(), 10.0f).visible, Indices{0});
    EXPECT_EQ(cull({{{0, 0, -10}, 0}}, make_view(), 10.0f).visible, Indices{}) << "range 0 affects nothing";
}

TEST(Cull, IgnoresAndCountsBadLightsAndNoOthers) {
    const ManylightsSphere good = {{0, 0, -10}, 1};
    const std::vector<ManylightsSphere> spheres = {
        good,
        {{kNan, 0, -10}, 1},
        {{0, kInfinity, -10}, 1},
        {{0, 0, -kInfinity}, 1},
        {{0, 0, -10}, kNan},
        {{0, 0, -10}, -1},
        {{0, 0, -10}, -kInfinity},
        good,
        {{0, 0, -10}, 0.0f},
        {{0, 0, -10}, -0.0f},
        {{0, 0, -10}, kInfinity},
    };
    const Culled culled = cull(spheres);
    EXPECT_EQ(culled.visible, (Indices{0, 7, 10}));
    EXPECT_EQ(culled.stats.ignored_lights, 6u);
    EXPECT_EQ(culled.stats.first_ignored, 1u);
    EXPECT_EQ(culled.stats.visible_lights, 3u);
    EXPECT_EQ(cull({good}).stats.ignored_lights, 0u);
}

TEST(Cull, HugeRangesReachEveryCell) {
    for (const float range : {1e6f, 1e18f, 3e38f, kInfinity}) {
        const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_LISTS));
        const std::vector<ManylightsSphere> spheres = {{{500, -300, 2000}, range}};
        Frame frame = build_frame(builder.get(), {make_view()}, spheres);
        for (const MlCell& cell : frame.cells) ASSERT_EQ(cell.count, 1u) << range;
    }
}

TEST(Cull, TakesLargerRangesAs1e18) {
    EXPECT_EQ(cull({{{0, 0, 9e17f}, 1e30f}}).visible, Indices{0});
    EXPECT_EQ(cull({{{0, 0, 1e19f}, 1e30f}}).visible, Indices{});
}

TEST(Cull, ReadsLightsWithTheirStride) {
    struct EngineLight {
        float color[3];
        ManylightsSphere sphere;
        float more[2];
    };
    std::vector<EngineLight> engine(3);
    engine[0].sphere = {{0, 0, 10}, 1};
    engine[1].sphere = {{0, 0, -10}, 1};
    engine[2].sphere = {{0, 0, -20}, 1};
    const BuilderPtr builder = make_builder(settings_of(MANYLIGHTS_STRUCTURE_LISTS));
    ManylightsLights lights{};
    lights.size = sizeof(lights);
    lights.spheres = &engine[0].sphere;
    lights.sphere_stride = sizeof(EngineLight);
    lights.count = 3;
    const ManylightsView view = make_view();
    ManylightsSizes sizes{};
    ASSERT_EQ(manylights_plan(builder.get(), &view, 1, &lights, &sizes, nullptr), MANYLIGHTS_OK);
    const std::uint32_t* indices = nullptr;
    std::uint32_t count = 0;
    ASSERT_EQ(manylights_visible(builder.get(), 0, &indices, &count, nullptr), MANYLIGHTS_OK);
    ASSERT_EQ(Indices(indices, indices + count), (Indices{1, 2}));
}

// As far from the world's origin as floats allow steps of centimetres: the same lights as at the origin, give or take
// the rounding of the scene itself.
TEST(Cull, CullingRadiusCoversWorldSpaceRounding) {
    const double plain = detail::culling_radius(1.0, 0.0, 10.0, 10.0, 0.0);
    EXPECT_GT(plain, 1.0 + 1e-6 * 11.0);
    EXPECT_LT(plain, 1.0 + 3e-5);
    const double far_away = detail::culling_radius(1.0, 0.0, 10.0, 1e5, 0.0);
    EXPECT_GE(far_away - 1.0, 4 * 0.0078125) << "4 ulp of 1e5";
    EXPECT_GE(detail::culling_radius(1.0, 0.5, 10.0, 10.0, 1e-3), 1.5 * 1.001 + 1e-3 * 10.0);
}

TEST(Cull, ExtremePositionsBreakNothing) {
    const std::vector<ManylightsSphere> spheres = {
        {{3e38f, 3e38f, 3e38f}, 1e18f}, {{-3e38f, 0, -3e38f}, 3e38f}, {{0, 0, -1e30f}, 1e18f}, {{0, 0, -10}, 1}};
    CameraOptions options;
    options.position = {-3e38, 0, 0};
    cull(spheres, make_view(options));
    const Culled culled = cull(spheres);
    EXPECT_EQ(culled.visible.back(), 3u);
}

} // namespace
} // namespace manylights::test
