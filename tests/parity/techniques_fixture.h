#pragma once
// What the tests of techniques share: one device with validation, and views whose points and lights are made by hand.

#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "lab/techniques/technique.h"

#include <gtest/gtest.h>

namespace manylights::lab {

/// Skips where there is no device; fails where validation had something to say.
class TechniquesTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;
    gpu::Device& device() const { return *device_; }

  private:
    gpu::Device* device_ = nullptr;
};

/// A frame with everything that it refers to.
struct View {
    Scene scene;
    Camera camera;
    std::uint32_t width, height;
    std::vector<PointPosition> positions;
    std::vector<PointNormal> normals;
    std::vector<Light> lights;
    PointBuffer points;

    Frame frame() const { return {scene, camera, width, height, lights, points}; }
};

/// Depths from 0.2 to 1000 in disorder, one pixel of eight is sky; the lights lie around points of the view, so that
/// each affects some.
View made_view(gpu::Device& device, std::uint32_t width, std::uint32_t height, std::uint32_t light_count);

/// At a quarter of the points a light that ends just in front of or just behind it, in line with the camera's forward
/// axis, where nothing but the depth can leave it out.
void add_lights_that_end_at_points(View& view);

/// A technique and its options, and a name that tests may carry.
struct Variant {
    const char* label;
    const char* technique;
    OptionValues options;
};
void PrintTo(const Variant& variant, std::ostream* out);

/// The structures, from both producers where both build them.
std::vector<Variant> structure_variants();
/// All that is compared with brute force: the structures and exact.
std::vector<Variant> all_variants();

std::vector<PixelRecord> records_of(gpu::Device& device, const Variant& variant, const Frame& frame);
inline const Variant kBruteForce{"brute_force", "brute_force", {}};

} // namespace manylights::lab
