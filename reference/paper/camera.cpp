#include "reference/paper/camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace manylights::paper {
namespace {

// Half extent in pixels and centre in pixels of one image axis: pixel = scale * slope + center.
struct Axis {
    double scale, center;
};

Axis pixel_axis(double ndc_scale, double ndc_offset, double size, bool against_clip) {
    const double direction = against_clip ? -1.0 : 1.0;
    return {direction * ndc_scale * 0.5 * size, (direction * ndc_offset * 0.5 + 0.5) * size};
}

// Normalized depth is a + b / depth. Reversed depth (b > 0) is 1 on the near plane. Standard depth is 0 there, or -1 in
// OpenGL's range, which the matrix does not tell apart: the nearer of the two is taken, which is conservative, since
// nothing is culled that lies beyond it. The last factor covers a point that rounding puts in front of its plane.
double near_depth(double a, double b) {
    const double depth = b > 0.0 ? b / (1.0 - a) : std::min(-b / a, -b / (a + 1.0));
    return depth * (1.0 - 0x1p-18);
}

void require(bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
}

// The camera's position solves R p + t = 0 for the rigid [R | t] that the matrix rounds to float. Its error, and that
// of world coordinates (4 ulp of the largest one promised, of which the light's own part is added by the culling), stay
// below 2^-20 of the sum of its coordinates each.
void read_position(const float* view_from_world, Camera& camera) {
    double largest = 0.0, sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double position = 0.0;
        for (int row = 0; row < 3; ++row)
            position -= double(view_from_world[4 * axis + row]) * view_from_world[12 + row];
        camera.position[axis] = float(position);
        largest = std::max(largest, std::abs(position));
        sum += std::abs(position);
    }
    camera.position_slack = float(0x1p-21 * largest + 0x1p-20 * sum);
}

} // namespace

Camera read_camera(const ManylightsView& view) {
    const float* clip = view.clip_from_view;
    const double w_scale = std::abs(double(clip[11]));
    require(clip[3] == 0.0f && clip[7] == 0.0f && clip[15] == 0.0f && w_scale > 0.0,
            "view.clip_from_view must be a perspective projection");
    require(clip[1] == 0.0f && clip[4] == 0.0f && clip[12] == 0.0f && clip[13] == 0.0f,
            "view.clip_from_view must not rotate or translate the image");
    const double side = clip[11] > 0.0f ? 1.0 : -1.0; // depth = side * view z

    const Axis columns = pixel_axis(clip[0] / w_scale, side * clip[8] / w_scale, view.width, false);
    const Axis rows = pixel_axis(clip[5] / w_scale, side * clip[9] / w_scale, view.height, view.clip_y_up != 0);

    Camera camera{};
    read_position(view.view_from_world, camera);
    for (int axis = 0; axis < 3; ++axis) {
        const float* column = view.view_from_world + 4 * axis;
        camera.right_from_world[axis] = columns.scale < 0.0 ? -column[0] : column[0];
        camera.down_from_world[axis] = rows.scale < 0.0 ? -column[1] : column[1];
        camera.depth_from_world[axis] = side < 0.0 ? -column[2] : column[2];
    }
    camera.scale_x = float(std::abs(columns.scale));
    camera.scale_y = float(std::abs(rows.scale));
    camera.center_x = float(columns.center);
    camera.center_y = float(rows.center);
    camera.near_depth = float(near_depth(side * clip[10] / w_scale, clip[14] / w_scale));
    camera.width = view.width;
    camera.height = view.height;
    camera.guard_px = view.guard_px;
    require(camera.scale_x > 0.0f && camera.scale_y > 0.0f && std::isfinite(camera.scale_x + camera.scale_y) &&
                camera.near_depth > 0.0f && std::isfinite(camera.near_depth),
            "view.clip_from_view must have a finite field of view and a near plane in front of the camera");
    return camera;
}

} // namespace manylights::paper
