#include "reference/oracle/cases.h"

#include <cmath>
#include <limits>

namespace manylights::oracle {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A random rotation, as rows: a unit quaternion drawn from the 4-ball.
void random_rotation(Random& random, Double3 rows[3]) {
    double x, y, z, w, squared;
    do {
        x = random.between(-1.0, 1.0);
        y = random.between(-1.0, 1.0);
        z = random.between(-1.0, 1.0);
        w = random.between(-1.0, 1.0);
        squared = x * x + y * y + z * z + w * w;
    } while (squared > 1.0 || squared < 1e-4);
    double s = 2.0 / squared;
    rows[0] = {1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)};
    rows[1] = {s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)};
    rows[2] = {s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)};
}

/// Rotation rounded to float; the translation is minus the rotated eye, computed from the rounded rotation.
void set_view_from_world(Camera& camera, const Double3 rows[3]) {
    float* m = camera.view.view_from_world;
    for (int row = 0; row < 3; ++row) {
        m[row] = static_cast<float>(rows[row].x);
        m[4 + row] = static_cast<float>(rows[row].y);
        m[8 + row] = static_cast<float>(rows[row].z);
        m[4 * row + 3] = 0.0f;
    }
    m[15] = 1.0f;
    Double3 t = view_from_relative(camera, {camera.eye[0], camera.eye[1], camera.eye[2]}) * -1.0;
    m[12] = static_cast<float>(t.x);
    m[13] = static_cast<float>(t.y);
    m[14] = static_cast<float>(t.z);
}

enum class DepthConvention { standard, reversed, minus_one_to_one };

/// Clip z = slope * depth + offset, with clip w = depth.
void set_clip_depth(Camera& camera, DepthConvention convention, double forward) {
    double n = camera.near_depth, f = camera.far_depth;
    bool open = f == kInfinity;
    double slope = 0.0, offset = 0.0;
    switch (convention) {
    case DepthConvention::standard:
        slope = open ? 1.0 : f / (f - n);
        offset = open ? -n : -f * n / (f - n);
        break;
    case DepthConvention::reversed:
        slope = open ? 0.0 : -n / (f - n);
        offset = open ? n : f * n / (f - n);
        break;
    case DepthConvention::minus_one_to_one:
        slope = open ? 1.0 : (f + n) / (f - n);
        offset = open ? -2.0 * n : -2.0 * f * n / (f - n);
        break;
    }
    float* m = camera.view.clip_from_view;
    m[10] = static_cast<float>(slope * forward);
    m[14] = static_cast<float>(offset);
    m[11] = static_cast<float>(forward);
    // Where the planes are is what the rounded matrix says: clip z / w = slope + offset / depth.
    double near_value =
        convention == DepthConvention::reversed ? 1.0 : (convention == DepthConvention::standard ? 0.0 : -1.0);
    double far_value = convention == DepthConvention::reversed ? 0.0 : 1.0;
    camera.near_depth = m[14] / (near_value - m[10] * forward);
    double far_depth = m[14] / (far_value - m[10] * forward);
    camera.far_depth = open || !(far_depth > 0.0) ? kInfinity : far_depth;
}

std::uint32_t random_edge(Random& random, std::uint32_t largest) {
    return random.chance(0.1) ? 1 + random.below(8) : 1 + random.below(largest);
}

} // namespace

Camera random_camera_at(Random& random, const float eye[3], const CameraOptions& options) {
    static constexpr float kGuards[] = {0.5f, 0.5f, 0.015625f, 1.0f, 2.5f, 8.0f, 64.0f};
    Camera camera;
    camera.view.size = sizeof(ManylightsView);
    camera.view.width = random_edge(random, options.largest_edge_px);
    camera.view.height = random_edge(random, options.largest_edge_px);
    camera.view.guard_px = kGuards[random.below(7)];
    camera.view.clip_y_up = random.below(2);
    for (int i = 0; i < 3; ++i) camera.eye[i] = eye[i];
    Double3 rows[3];
    random_rotation(random, rows);
    if (random.chance(0.25)) rows[0] = rows[0] * -1.0;
    set_view_from_world(camera, rows);

    float* m = camera.view.clip_from_view;
    m[0] = static_cast<float>(random.sign() / random.octaves(-3, 0));
    m[5] = static_cast<float>(random.sign() / random.octaves(-3, 0));
    double off_centre = random.chance(0.3) ? 1.5 : (random.chance(0.5) ? 0.001 : 0.0);
    m[8] = static_cast<float>(random.between(-off_centre, off_centre));
    m[9] = static_cast<float>(random.between(-off_centre, off_centre));
    camera.near_depth = random.octaves(-7, 0);
    camera.far_depth = random.chance(0.5) ? kInfinity : camera.near_depth * random.octaves(5, 18);
    set_clip_depth(camera, static_cast<DepthConvention>(random.below(3)), random.sign());
    return camera;
}

Camera random_camera(Random& random, const CameraOptions& options) {
    static constexpr double kOffsets[] = {0.0, 1e-3, 1e-2, 1.0};
    double offset = kOffsets[random.below(4)] * options.largest_offset;
    float eye[3];
    for (float& coordinate : eye) coordinate = static_cast<float>(random.between(-offset, offset));
    return random_camera_at(random, eye, options);
}

Camera plain_camera(std::uint32_t width, std::uint32_t height, double tan_half_y, const float eye[3], float guard_px) {
    Camera camera;
    camera.view.size = sizeof(ManylightsView);
    camera.view.width = width;
    camera.view.height = height;
    camera.view.guard_px = guard_px;
    for (int i = 0; i < 3; ++i) camera.eye[i] = eye[i];
    const Double3 rows[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    set_view_from_world(camera, rows);
    camera.view.clip_from_view[0] = static_cast<float>(1.0 / (tan_half_y * width / height));
    camera.view.clip_from_view[5] = static_cast<float>(-1.0 / tan_half_y);
    camera.near_depth = 0.1f;
    camera.far_depth = kInfinity;
    set_clip_depth(camera, DepthConvention::reversed, -1.0);
    return camera;
}

float least_range(MlFloat3 point, MlFloat3 center) {
    float range = static_cast<float>(length(to_double(point) - to_double(center)));
    if (range < 1e-15f) return 1e-15f; // its square is a normal number still
    for (int i = 0; i < 4; ++i) range = std::nextafter(range, 0.0f);
    while (!ml_affects(point, center, range)) range = std::nextafter(range, INFINITY);
    return range;
}

ManylightsSphere light_reaching(Random& random, const float eye[3], MlFloat3 point, double distance, double excess) {
    MlFloat3 center = to_float(to_double(point) + random.direction() * distance);
    ManylightsSphere sphere{{eye[0] + center.x, eye[1] + center.y, eye[2] + center.z}, 0.0f};
    float least = least_range(point, camera_relative(sphere.center, eye));
    sphere.range = std::fmax(least, static_cast<float>(least * (1.0 + excess)));
    return sphere;
}

} // namespace manylights::oracle
