// shading.glsl on the device: against closed forms, and never non-finite.

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "tests/parity/validated_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kCode[] =
#include "gpu_shading.comp.inc"
    ;

/// The same text as Case in gpu_shading.comp.
struct Case {
    glm::vec3 position{0.0f, 0.0f, -2.0f}, normal{0.0f, 0.0f, 1.0f};
    MaterialRecord material{glm::vec3(0.5f), 1.0f, glm::vec3(0.0f), 0.0f};
    glm::vec3 center{0.0f, 0.0f, -1.0f};
    float range = 10.0f;
    glm::vec3 intensity{1.0f};
};
static_assert(sizeof(Case) == 84);

struct Answer {
    glm::vec4 lit, unlit;
};

std::vector<Answer> shade(const std::vector<Case>& cases) {
    gpu::Device& device = validated_device();
    const gpu::ComputePipeline pipeline(device, {"shading", kCode, 2, 4, {}});
    const gpu::Buffer input(device, "cases", std::span<const Case>(cases));
    gpu::Buffer output(device, "answers", cases.size() * sizeof(Answer), gpu::Memory::readback);
    output.fill(0xFFFFFFFFu);
    const auto count = std::uint32_t(cases.size());
    gpu::Commands commands(device);
    commands.dispatch(pipeline, {{input}, {output}}, count, {gpu::group_count(count, 64), 1, 1});
    commands.submit_and_wait();
    EXPECT_EQ(device.validation_messages(), 0u);
    return output.download<Answer>();
}

// KHR_lights_punctual, written down once more.
double falloff(double distance, double range) {
    const double ratio = distance / range;
    return std::max(0.0, std::min(1.0, 1.0 - ratio * ratio * ratio * ratio)) / (distance * distance);
}

TEST(Shading, follows_the_falloff_with_distance) {
    std::vector<Case> cases;
    for (const float distance : {0.5f, 1.0f, 2.0f, 5.0f, 9.0f, 9.99f, 10.0f, 11.0f}) {
        Case c;
        c.center.z = c.position.z + distance;
        cases.push_back(c);
    }
    const std::vector<Answer> answers = shade(cases);
    // All cases see the same angles, so the falloff is all that differs.
    const double scale = double(answers[1].lit.x) / falloff(1.0, 10.0);
    EXPECT_NEAR(scale, 0.5 * (1.0 - 0.04) / 3.14159265 + 0.04 / (4.0 * 3.14159265), 1e-4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double distance = double(cases[i].center.z) - double(cases[i].position.z);
        EXPECT_NEAR(double(answers[i].lit.x), scale * falloff(distance, 10.0), 1e-5 * scale) << distance;
    }
}

TEST(Shading, leaves_surfaces_that_face_away_unlit) {
    Case behind;
    behind.center.z = -3.0f;
    Case level;
    level.center = {1.0f, 0.0f, -2.0f};
    for (const Answer& answer : shade({behind, level})) EXPECT_EQ(glm::vec3(answer.lit), glm::vec3(0.0f));
}

TEST(Shading, tints_metal_and_not_the_highlight_of_plastic) {
    Case plastic;
    plastic.material = {glm::vec3(1.0f, 0.0f, 0.0f), 0.1f, glm::vec3(0.0f), 0.0f};
    Case metal = plastic;
    metal.material.metallic = 1.0f;
    const std::vector<Answer> answers = shade({plastic, metal});
    EXPECT_GT(answers[0].lit.y, 1.0f);
    EXPECT_EQ(answers[1].lit.y, 0.0f);
    EXPECT_GT(answers[1].lit.x, answers[0].lit.x);
}

TEST(Shading, adds_emission_and_ambient_light_without_any_light) {
    Case glowing;
    glowing.material.emissive = {3.0f, 2.0f, 1.0f};
    Case black;
    black.material.base_color = glm::vec3(0.0f);
    const std::vector<Answer> answers = shade({glowing, black, Case{}});
    EXPECT_GT(answers[0].unlit.x, 3.0f);
    EXPECT_EQ(glm::vec3(answers[1].unlit), glm::vec3(0.0f));
    EXPECT_GT(answers[2].unlit.x, 0.0f);
    EXPECT_FLOAT_EQ(answers[0].unlit.x - answers[2].unlit.x, 3.0f);
}

// Every combination of the values that make denominators zero or infinite.
TEST(Shading, is_finite_and_not_negative_for_every_input) {
    std::vector<Case> cases;
    for (const float offset : {0.0f, 1e-30f, 1e-10f, 1e-3f, 1.0f, 1e10f, 1e18f, -1e-3f, -1e18f})
        for (const float range : {0.0f, 1e-38f, 1e-10f, 1.0f, 1e18f})
            for (const float roughness : {0.0f, 0.5f, 1.0f})
                for (const float metallic : {0.0f, 1.0f})
                    for (const float depth : {0.0f, 1e-20f, 2.0f, 1e18f})
                        for (const float side : {0.0f, 1.0f, -2.0f}) {
                            Case c;
                            c.position.z = -depth;
                            c.center = {side * offset, 0.0f, offset - depth};
                            c.range = range;
                            c.material.roughness = roughness;
                            c.material.metallic = metallic;
                            c.intensity = glm::vec3(1e20f, 1.0f, 0.0f);
                            cases.push_back(c);
                        }
    const std::vector<Answer> answers = shade(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float lit = answers[i].lit[channel], unlit = answers[i].unlit[channel];
            ASSERT_TRUE(std::isfinite(lit) && lit >= 0.0f) << i << ": " << lit;
            ASSERT_TRUE(std::isfinite(unlit) && unlit >= 0.0f) << i << ": " << unlit;
        }
}

} // namespace
} // namespace manylights::lab
