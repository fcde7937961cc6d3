#include "reference/oracle/camera.h"

#include <cmath>

namespace manylights::oracle {

namespace {

/// Element of a column-major matrix.
double at(const float* matrix, int row, int column) { return matrix[4 * column + row]; }

/// The neighbours of `value`: itself and one unit in the last place to either side.
float neighbour(float value, int which) {
    return which == 0 ? value : std::nextafter(value, which > 0 ? INFINITY : -INFINITY);
}

template <typename Error>
MlFloat3 best_neighbour(MlFloat3 start, Error error) {
    MlFloat3 best = start;
    for (int i = 0; i < 27; ++i) {
        MlFloat3 candidate{neighbour(start.x, i % 3 - 1), neighbour(start.y, i / 3 % 3 - 1),
                           neighbour(start.z, i / 9 - 1)};
        if (error(candidate) < error(best)) best = candidate;
    }
    return best;
}

} // namespace

Double3 view_from_relative(const Camera& camera, Double3 v) {
    const float* m = camera.view.view_from_world;
    return {at(m, 0, 0) * v.x + at(m, 0, 1) * v.y + at(m, 0, 2) * v.z,
            at(m, 1, 0) * v.x + at(m, 1, 1) * v.y + at(m, 1, 2) * v.z,
            at(m, 2, 0) * v.x + at(m, 2, 1) * v.y + at(m, 2, 2) * v.z};
}

Double3 relative_from_view(const Camera& camera, Double3 v) {
    // The rotation is orthonormal up to its rounding to float; one Newton step on the transpose's answer removes that.
    const float* m = camera.view.view_from_world;
    auto transposed = [m](Double3 p) {
        return Double3{at(m, 0, 0) * p.x + at(m, 1, 0) * p.y + at(m, 2, 0) * p.z,
                       at(m, 0, 1) * p.x + at(m, 1, 1) * p.y + at(m, 2, 1) * p.z,
                       at(m, 0, 2) * p.x + at(m, 1, 2) * p.y + at(m, 2, 2) * p.z};
    };
    Double3 relative = transposed(v);
    return relative + transposed(v - view_from_relative(camera, relative));
}

Double3 view_from_world(const Camera& camera, const float world[3]) {
    const float* m = camera.view.view_from_world;
    return view_from_relative(camera, {world[0], world[1], world[2]}) + Double3{at(m, 0, 3), at(m, 1, 3), at(m, 2, 3)};
}

ScreenPosition project_view_space(const Camera& camera, Double3 v) {
    const float* m = camera.view.clip_from_view;
    double w = at(m, 3, 0) * v.x + at(m, 3, 1) * v.y + at(m, 3, 2) * v.z + at(m, 3, 3);
    double x = (at(m, 0, 0) * v.x + at(m, 0, 1) * v.y + at(m, 0, 2) * v.z + at(m, 0, 3)) / w;
    double y = (at(m, 1, 0) * v.x + at(m, 1, 1) * v.y + at(m, 1, 2) * v.z + at(m, 1, 3)) / w;
    double down = camera.view.clip_y_up != 0 ? -y : y;
    double depth = at(m, 3, 2) < 0.0 ? -v.z : v.z;
    return {(x + 1.0) * 0.5 * camera.view.width, (down + 1.0) * 0.5 * camera.view.height, depth};
}

ScreenPosition project(const Camera& camera, MlFloat3 relative) {
    return project_view_space(camera, view_from_relative(camera, to_double(relative)));
}

Double3 unproject_view_space(const Camera& camera, ScreenPosition screen) {
    // A perspective projection has clip x = m00 x + m02 z and clip w = m32 z, likewise for y.
    const float* m = camera.view.clip_from_view;
    double z = at(m, 3, 2) < 0.0 ? -screen.depth : screen.depth;
    double w = at(m, 3, 2) * z;
    double x = screen.x / camera.view.width * 2.0 - 1.0;
    double y = screen.y / camera.view.height * 2.0 - 1.0;
    if (camera.view.clip_y_up != 0) y = -y;
    return {(x * w - at(m, 0, 2) * z) / at(m, 0, 0), (y * w - at(m, 1, 2) * z) / at(m, 1, 1), z};
}

MlFloat3 unproject(const Camera& camera, ScreenPosition screen) {
    return to_float(relative_from_view(camera, unproject_view_space(camera, screen)));
}

MlFloat3 unproject_precisely_along_x(const Camera& camera, ScreenPosition screen) {
    return best_neighbour(unproject(camera, screen),
                          [&](MlFloat3 p) { return std::fabs(project(camera, p).x - screen.x); });
}

MlFloat3 unproject_precisely_along_y(const Camera& camera, ScreenPosition screen) {
    return best_neighbour(unproject(camera, screen),
                          [&](MlFloat3 p) { return std::fabs(project(camera, p).y - screen.y); });
}

} // namespace manylights::oracle
