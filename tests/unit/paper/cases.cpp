#include "tests/unit/paper/cases.h"

#include <algorithm>
#include <cmath>

namespace manylights::paper {
namespace {

struct Basis {
    std::array<double, 3> right, up, forward;
};

Basis basis_of(const CameraCase& camera) {
    const double cy = std::cos(camera.yaw), sy = std::sin(camera.yaw);
    const double cp = std::cos(camera.pitch), sp = std::sin(camera.pitch);
    const double cr = std::cos(camera.roll), sr = std::sin(camera.roll);
    const std::array<double, 3> right{cy, 0.0, sy}, up{-sy * sp, cp, cy * sp}, forward{sy * cp, sp, -cy * cp};
    Basis basis{right, up, forward};
    for (int i = 0; i < 3; ++i) {
        basis.right[i] = cr * right[i] + sr * up[i];
        basis.up[i] = cr * up[i] - sr * right[i];
    }
    return basis;
}

double dot(const std::array<double, 3>& a, const MlFloat3& b) { return a[0] * b.x + a[1] * b.y + a[2] * b.z; }

constexpr double kCotHalf = 1.7320508075688772; // 60 degrees vertically

double cot_half_x(const CameraCase& camera) { return kCotHalf * camera.height / camera.width; }

} // namespace

double Random::unit() {
    state_ += 0x9E3779B97F4A7C15ull;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return double((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

std::array<double, 3> Random::direction() {
    for (;;) {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > 0.1 && length < 1.0) return {x / length, y / length, z / length};
    }
}

std::vector<CameraCase> camera_cases() {
    CameraCase plain;
    CameraCase far_away{.name = "far from the origin"};
    far_away.position[0] = 1e5f;
    CameraCase standard{.name = "standard depth, finite far", .roll = 1.0, .far_depth = 700.0, .reversed = false};
    CameraCase plus_z{.name = "looks along +z, y up", .yaw = 2.5, .looks_along_plus_z = true, .clip_y_up = true};
    CameraCase off_center{.name = "off centre", .offset_x = 0.4, .offset_y = -0.7};
    CameraCase guarded{.name = "guard 8", .yaw = -1.0, .width = 97, .height = 51, .guard_px = 8.0f};
    CameraCase single{.name = "one pixel", .width = 1, .height = 1};
    return {plain, far_away, standard, plus_z, off_center, guarded, single};
}

ManylightsView make_view(const CameraCase& camera) {
    const Basis basis = basis_of(camera);
    const double side = camera.looks_along_plus_z ? 1.0 : -1.0;
    ManylightsView view{};
    view.size = sizeof(view);
    for (int i = 0; i < 3; ++i) {
        const double rows[3] = {basis.right[i], basis.up[i], side * basis.forward[i]};
        for (int row = 0; row < 3; ++row) view.view_from_world[4 * i + row] = float(rows[row]);
    }
    const std::array<double, 3>* axes[3] = {&basis.right, &basis.up, &basis.forward};
    const MlFloat3 position{camera.position[0], camera.position[1], camera.position[2]};
    for (int row = 0; row < 3; ++row)
        view.view_from_world[12 + row] = float((row == 2 ? -side : -1.0) * dot(*axes[row], position));
    view.view_from_world[15] = 1.0f;

    const double n = camera.near_depth, f = camera.far_depth;
    double a = camera.reversed ? 0.0 : 1.0, b = camera.reversed ? n : -n; // normalized depth a + b / depth
    if (f != 0.0) {
        a = camera.reversed ? -n / (f - n) : f / (f - n);
        b = camera.reversed ? f * n / (f - n) : -f * n / (f - n);
    }
    const double up = camera.clip_y_up ? 1.0 : -1.0;
    view.clip_from_view[0] = float(cot_half_x(camera));
    view.clip_from_view[5] = float(up * kCotHalf);
    view.clip_from_view[8] = float(side * camera.offset_x);
    view.clip_from_view[9] = float(side * -up * camera.offset_y);
    view.clip_from_view[10] = float(side * a);
    view.clip_from_view[11] = float(side);
    view.clip_from_view[14] = float(b);
    view.width = camera.width;
    view.height = camera.height;
    view.guard_px = camera.guard_px;
    view.clip_y_up = camera.clip_y_up ? 1 : 0;
    return view;
}

ImagePoint project(const CameraCase& camera, const MlFloat3& point) {
    const Basis basis = basis_of(camera);
    const double depth = dot(basis.forward, point);
    const double x = cot_half_x(camera) * dot(basis.right, point) / depth + camera.offset_x;
    const double down = -kCotHalf * dot(basis.up, point) / depth + camera.offset_y;
    return {(0.5 * x + 0.5) * camera.width, (0.5 * down + 0.5) * camera.height, depth};
}

MlFloat3 ahead_of(const CameraCase& camera) {
    const auto forward = basis_of(camera).forward;
    return {float(forward[0]), float(forward[1]), float(forward[2])};
}

std::vector<ManylightsSphere> random_lights(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<ManylightsSphere> lights(count);
    for (ManylightsSphere& light : lights) {
        const bool large = random.unit() < 0.01;
        light = {{float(random.between(-100, 100)), float(random.between(0, 60)), float(random.between(-300, 300))},
                 float(large ? random.between(30, 80) : random.between(0.05, 8))};
    }
    return lights;
}

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres) {
    return {sizeof(ManylightsLights), spheres.data(), 0, std::uint32_t(spheres.size()), 0.0f};
}

MlFloat3 relative_to(const CameraCase& camera, const float* world) {
    return {world[0] - camera.position[0], world[1] - camera.position[1], world[2] - camera.position[2]};
}

std::vector<PointCase> points_in_lights(const CameraCase& camera, const std::vector<ManylightsSphere>& lights,
                                        std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<PointCase> points;
    const double guard = camera.guard_px;
    for (std::uint32_t attempt = 0; attempt < 40 * count && points.size() < count && !lights.empty(); ++attempt) {
        const ManylightsSphere& light = lights[random.below(std::uint32_t(lights.size()))];
        const MlFloat3 center = relative_to(camera, light.center);
        const auto direction = random.direction();
        const bool close = random.unit() < 0.25;
        const double radius = light.range * (close ? 1.0 - random.between(0.0, 1e-6) : random.unit());
        const MlFloat3 point{float(center.x + radius * direction[0]), float(center.y + radius * direction[1]),
                             float(center.z + radius * direction[2])};
        const ImagePoint image = project(camera, point);
        if (!(image.depth >= camera.near_depth)) continue;
        const double x = std::floor(image.x + random.between(-guard, guard)) + 0.5;
        const double y = std::floor(image.y + random.between(-guard, guard)) + 0.5;
        if (!(x > 0 && x < camera.width && y > 0 && y < camera.height)) continue;
        if (std::abs(x - image.x) > guard || std::abs(y - image.y) > guard) continue;
        const double depth = image.depth * (1.0 + random.between(-0.9, 0.9) * 0x1p-20);
        points.push_back({{float(x), float(y)}, float(depth), point});
    }
    return points;
}

std::vector<std::uint32_t> affecting_lights(const CameraCase& camera, const std::vector<ManylightsSphere>& lights,
                                            const MlFloat3& point) {
    std::vector<std::uint32_t> affecting;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
        if (ml_affects(point, relative_to(camera, lights[i].center), lights[i].range)) affecting.push_back(i);
    return affecting;
}

} // namespace manylights::paper
