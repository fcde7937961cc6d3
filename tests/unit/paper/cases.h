#pragma once
// Cameras, lights and points for the pipeline's tests, in double precision where the pipeline is in float.

#include <manylights/format.h>
#include <manylights/manylights.h>

#include <array>
#include <cstdint>
#include <vector>

namespace manylights::paper {

/// Seeded random numbers from an integer hash.
class Random {
  public:
    explicit Random(std::uint32_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 1) {}
    double unit(); ///< [0, 1)
    double between(double low, double high) { return low + (high - low) * unit(); }
    std::uint32_t below(std::uint32_t count) { return std::uint32_t(unit() * count); }
    std::array<double, 3> direction(); ///< unit length

  private:
    std::uint64_t state_;
};

struct CameraCase {
    const char* name = "plain";
    float position[3]{3.0f, 20.0f, 250.0f};
    double yaw = 0.3, pitch = -0.1, roll = 0.0; ///< radians
    double near_depth = 0.1;
    double far_depth = 0.0;                ///< 0: infinite
    double offset_x = 0.0, offset_y = 0.0; ///< of the image centre, in normalized coordinates
    bool reversed = true, looks_along_plus_z = false, clip_y_up = false;
    std::uint32_t width = 640, height = 360;
    float guard_px = 0.5f;
};

std::vector<CameraCase> camera_cases();
ManylightsView make_view(const CameraCase& camera);

/// Where a point, relative to the camera along the world's axes, lies in the image.
struct ImagePoint {
    double x, y, depth; ///< pixels, pixels, view depth
};
ImagePoint project(const CameraCase& camera, const MlFloat3& point);

/// The viewing direction, unit length.
MlFloat3 ahead_of(const CameraCase& camera);

std::vector<ManylightsSphere> random_lights(std::uint32_t count, std::uint32_t seed);
ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres);

/// Each coordinate rounded once.
MlFloat3 relative_to(const CameraCase& camera, const float* world);

/// A point that the promise speaks of: what to ask for, and what is affected.
struct PointCase {
    MlFloat2 position; ///< a pixel centre
    float depth;
    MlFloat3 point;
};
/// Points inside the volumes of random lights, a quarter of them close to the surface; pixels up to guard_px away,
/// depths up to 2^-20. Only points in view.
std::vector<PointCase> points_in_lights(const CameraCase& camera, const std::vector<ManylightsSphere>& lights,
                                        std::uint32_t count, std::uint32_t seed);

/// By the membership rule alone; ascending.
std::vector<std::uint32_t> affecting_lights(const CameraCase& camera, const std::vector<ManylightsSphere>& lights,
                                            const MlFloat3& point);

} // namespace manylights::paper
