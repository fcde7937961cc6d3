// Every structure, from lights to the shader's answer: complete, without repeats, valid.

#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace manylights::test {
namespace {

class Structures : public testing::TestWithParam<std::uint32_t> {};

std::string structure_name(const testing::TestParamInfo<std::uint32_t>& tested) {
    constexpr const char* kNames[] = {"default", "lists", "trees", "hybrid", "windows"};
    return kNames[tested.param];
}

INSTANTIATE_TEST_SUITE_P(All, Structures,
                         testing::Values(MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                         MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS),
                         structure_name);

// A camera at the origin that looks along world -z; the options' image.
struct Shot {
    float x, y, depth;
    MlFloat3 point; // relative to the camera
};

Shot shoot(Random& random, const CameraOptions& options) {
    Shot shot{};
    shot.x = std::floor(random.between(0, options.width)) + 0.5f;
    shot.y = std::floor(random.between(0, options.height)) + 0.5f;
    shot.depth = static_cast<float>(0.2 * std::pow(2.0, random.unit() * 12.0));
    const double aspect = static_cast<double>(options.width) / options.height;
    const double ndc_x = 2.0 * static_cast<double>(shot.x) / options.width - 1.0;
    const double ndc_y = 2.0 * static_cast<double>(shot.y) / options.height - 1.0;
    const auto depth = static_cast<double>(shot.depth);
    shot.point = {static_cast<float>(ndc_x * options.tangent * aspect * depth),
                  static_cast<float>(-ndc_y * options.tangent * depth), -shot.depth};
    return shot;
}

std::vector<MlUint> affecting(const std::vector<ManylightsSphere>& spheres, MlFloat3 point) {
    std::vector<MlUint> found;
    for (MlUint i = 0; i < spheres.size(); ++i) {
        const ManylightsSphere& s = spheres[i];
        if (ml_affects(point, {s.center[0], s.center[1], s.center[2]}, s.range)) found.push_back(i);
    }
    return found;
}

TEST_P(Structures, HandOutEveryAffectingLightOnce) {
    for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1234u, 65537u}) {
        const CameraOptions options;
        const BuilderPtr builder = make_builder(settings_of(GetParam()));
        const auto spheres = make_lights(count, count + 7, 60.0, 0.1, count > 10000 ? 3.0 : 20.0);
        Frame frame = build_frame(builder.get(), {make_view(options)}, spheres);
        const ManylightsReport report = validate(builder.get(), frame, count);
        ASSERT_EQ(report.status, MANYLIGHTS_OK) << count << ": " << report.field << " " << report.rule;

        Random random(count);
        std::size_t found = 0;
        for (int i = 0; i < 200; ++i) {
            const Shot shot = shoot(random, options);
            auto handed = lights_at(frame, 0, shot.x, shot.y, shot.depth);
            std::sort(handed.begin(), handed.end());
            ASSERT_EQ(std::adjacent_find(handed.begin(), handed.end()), handed.end()) << "a light came twice";
            const auto expected = affecting(spheres, shot.point);
            found += expected.size();
            ASSERT_TRUE(std::includes(handed.begin(), handed.end(), expected.begin(), expected.end()))
                << count << " lights, pixel " << shot.x << " " << shot.y << " depth " << shot.depth;
        }
        EXPECT_TRUE(count < 1234 || found > 100) << "the test must see affecting lights, saw " << found;
    }
}

// The packed fields of a node: 65,535 lights per leaf, 16,384 leaves per tree.
TEST_P(Structures, HoldMoreLightsInOneCellThanPackedFieldsCount) {
    for (const std::uint32_t count : {65535u, 65536u, 65537u, 200000u}) {
        CameraOptions options;
        options.width = options.height = 48;
        // All around the point at depth 30, so that every query there must hand out all of them.
        auto spheres = make_lights(count, 3, 1.0, 50.0, 60.0);
        for (ManylightsSphere& s : spheres) s.center[2] -= 30.0f;
        const BuilderPtr builder = make_builder(settings_of(GetParam()));
        Frame frame = build_frame(builder.get(), {make_view(options)}, spheres);
        const ManylightsReport report = validate(builder.get(), frame, count);
        ASSERT_EQ(report.status, MANYLIGHTS_OK) << count << ": " << report.field << " " << report.rule;
        auto handed = lights_at(frame, 0, 24.5f, 24.5f, 30.0f);
        std::sort(handed.begin(), handed.end());
        std::vector<MlUint> all(count);
        std::iota(all.begin(), all.end(), 0u);
        ASSERT_EQ(handed, all);
    }
}

} // namespace
} // namespace manylights::test
