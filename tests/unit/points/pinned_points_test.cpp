// The light sets of the pinned points by plain brute force, without a device: one number per view.

#include "lab/techniques/verification.h"
#include "reference/oracle/light_hash.h"
#include "reference/oracle/light_set.h"
#include "tests/unit/points/pinned_view.h"

#include <gtest/gtest.h>

namespace manylights::lab {
namespace {

ManylightsLights public_lights(const std::vector<Light>& lights) {
    ManylightsLights result{};
    result.size = sizeof result;
    result.spheres = &lights.front().sphere;
    result.sphere_stride = sizeof(Light);
    result.count = static_cast<std::uint32_t>(lights.size());
    return result;
}

// The cosine as shade_light of shading_pass.glsl computes it: the normal and the direction as they are, summed in
// order.
bool is_front(const SavedPoint& point, const MlFloat3& center) {
    const glm::vec3 to_light = glm::vec3(center.x, center.y, center.z) - point.position;
    const glm::vec3& normal = point.normal;
    return normal.x * to_light.x + normal.y * to_light.y + normal.z * to_light.z > 0.0f;
}

PixelRecord record_of(const SavedPoint& point, const std::vector<oracle::RelativeLight>& lights) {
    const glm::vec3& p = point.position;
    const oracle::LightSet all = oracle::affecting_lights({p.x, p.y, p.z}, lights);
    oracle::LightSet front;
    for (const std::uint32_t light : all.indices)
        if (is_front(point, lights.at(light).center)) front.add(light);
    PixelRecord record{};
    record.shaded = 1;
    record.affecting = static_cast<std::uint32_t>(all.indices.size());
    record.hash_a = all.hash_a;
    record.hash_b = all.hash_b;
    record.front = static_cast<std::uint32_t>(front.indices.size());
    record.front_hash_a = front.hash_a;
    record.front_hash_b = front.hash_b;
    return record;
}

class PinnedPoints : public testing::TestWithParam<PinnedView> {};

TEST_P(PinnedPoints, have_the_pinned_light_sets) {
    const LoadedView view = load_view(GetParam());
    EXPECT_EQ(view.saved.scene, GetParam().scene);
    ASSERT_EQ(view.lights.size(), kPinnedLights);
    const std::vector<oracle::RelativeLight> lights =
        oracle::relative_lights(public_lights(view.lights), &view.saved.camera.position.x);
    ASSERT_EQ(lights.size(), kPinnedLights) << "all usable, so the index is the place";
    std::vector<PixelRecord> records(std::size_t{view.saved.width} * view.saved.height, PixelRecord{});
    std::uint64_t affecting = 0;
    for (const SavedPoint& point : view.saved.points) {
        records.at(point.pixel) = record_of(point, lights);
        affecting += records[point.pixel].affecting;
    }
    EXPECT_EQ(affecting, GetParam().affecting);
    EXPECT_EQ(light_set_hash(records), GetParam().light_set_hash) << std::hex << light_set_hash(records);
}

INSTANTIATE_TEST_SUITE_P(Views, PinnedPoints, testing::ValuesIn(kPinnedViews),
                         [](const auto& view) { return std::string(view.param.scene); });

} // namespace
} // namespace manylights::lab
