// The first passes of techniques that build on the device: lights in view, and depth slices.

#include "lab/techniques/device/depth_slices.h"
#include "lab/techniques/device/visible_lights.h"
#include "lab/techniques/light_stream.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::lab {
namespace {

class VisibleLightsTest : public TechniquesTest {
  protected:
    std::vector<VisibleLight> find(const Frame& frame) {
        const LightStream stream = make_light_stream(frame);
        const gpu::Buffer spheres(device(), "spheres", std::span<const glm::vec4>(stream.spheres));
        VisibleLights visible(device());
        visible.find(device_view(frame), spheres, stream.light_count());
        return visible.lights().download<VisibleLight>(visible.count());
    }
};

TEST_F(VisibleLightsTest, hold_each_light_that_affects_a_point_with_the_points_pixel) {
    std::size_t affecting = 0;
    for (const std::uint32_t light_count : {1u, 63u, 64u, 65u, 900u}) {
        const View view = made_view(device(), 97, 60, light_count);
        const std::vector<VisibleLight> found = find(view.frame());
        const LightStream stream = make_light_stream(view.frame());
        for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
            if (view.positions[pixel].depth == 0.0f) continue;
            for (const std::uint32_t index : affecting_lights(stream, view.positions[pixel].position)) {
                const auto light = std::ranges::lower_bound(found, index, {}, &VisibleLight::index);
                ASSERT_TRUE(light != found.end() && light->index == index) << "light " << index;
                const std::uint32_t x = pixel % view.width, y = static_cast<std::uint32_t>(pixel / view.width);
                EXPECT_TRUE(x >= (light->columns & 0xFFFF) && x <= light->columns >> 16);
                EXPECT_TRUE(y >= (light->rows & 0xFFFF) && y <= light->rows >> 16);
                EXPECT_LE(std::fabs(light->sphere.z - view.positions[pixel].depth), light->sphere.w);
                ++affecting;
            }
        }
    }
    EXPECT_GT(affecting, 1000u);
}

TEST_F(VisibleLightsTest, leave_out_what_is_behind_beside_or_affects_nothing_and_keep_what_is_everywhere) {
    View view = made_view(device(), 97, 60, 1);
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    const auto light_at = [&](glm::vec3 offset, float range) {
        const glm::vec3 p =
            view.camera.position + offset.x * basis.right + offset.y * basis.up + offset.z * basis.forward;
        return Light{{{p.x, p.y, p.z}, range}, {1, 1, 1}};
    };
    const float infinity = std::numeric_limits<float>::infinity();
    view.lights = {light_at({0, 0, -10}, 5),  light_at({100, 0, 10}, 5),    light_at({0, -100, 10}, 5),
                   light_at({0, 0, 10}, 0),   light_at({0, 0, 10}, -1),     light_at({infinity, 0, 10}, 5),
                   light_at({0, 0, 10}, 5),   light_at({0, 0, -10}, 1e18f), light_at({0, 0, 0}, 0.2f),
                   light_at({0, 0, 1e12f}, 1)};
    std::vector<std::uint32_t> indices;
    for (const VisibleLight& light : find(view.frame())) indices.push_back(light.index);
    EXPECT_EQ(indices, (std::vector<std::uint32_t>{6, 7, 8, 9}));
    view.lights.clear();
    EXPECT_TRUE(find(view.frame()).empty());
}

TEST(DepthSlices, ascend_from_zero_to_infinity) {
    for (const SliceEdges& edges :
         {exponential_slices(5, 500, 16), exponential_slices(5, 500, 1), self_similar_slices(0.1f, 100, 1.05f),
          geometric_slices(0.1f, 300, 4096), uniform_slices(0.1f, 300, 128), screen_uniform_slices(0.1f, 300, 256)}) {
        EXPECT_EQ(edges.front(), 0.0f);
        EXPECT_EQ(edges.back(), std::numeric_limits<float>::infinity());
        EXPECT_TRUE(std::ranges::is_sorted(edges, std::less_equal<>())) << "no slice is empty";
    }
    EXPECT_EQ(slice_count(exponential_slices(5, 500, 16)), 16u);
    EXPECT_NEAR(exponential_slices(5, 500, 16)[15], 368, 1);
    EXPECT_EQ(slice_count(self_similar_slices(1, 8, 2)), 3u) << "0 to 2, 2 to 4, 4 on";
    EXPECT_NEAR(geometric_slices(2, 32, 4)[1], 4, 1e-5);
    EXPECT_NEAR(uniform_slices(1, 101, 4)[2], 51, 1e-3);
    EXPECT_NEAR(screen_uniform_slices(1, 100, 2)[1], 1.0 / (1.0 - 0.99 / 2), 1e-5);
}

} // namespace
} // namespace manylights::lab
