#include "lab/scene/camera.h"

#include <cmath>

namespace manylights::lab {
namespace {

/// Tangent of x in (0, 1.5] from the Taylor series of sine and cosine: the image's extent decides which point a pixel
/// sees, so it must not depend on a maths library. 30 terms leave less than 1e-16.
double tangent(double x) {
    double sine = 0.0, cosine = 0.0, term = 1.0;
    for (int n = 0; n < 30; ++n) {
        const double sign = (n / 2) % 2 == 0 ? 1.0 : -1.0;
        (n % 2 == 0 ? cosine : sine) += sign * term;
        term *= x / (n + 1);
    }
    return sine / cosine;
}

glm::vec3 normalized(glm::vec3 v) { return v / std::sqrt(glm::dot(v, v)); }

} // namespace

CameraBasis camera_basis(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    CameraBasis basis{};
    basis.forward = normalized(camera.forward);
    basis.right = normalized(glm::cross(basis.forward, camera.up));
    basis.up = glm::cross(basis.right, basis.forward);
    const double tan_half_y = tangent(0.5 * double(camera.vertical_fov));
    basis.tan_half_y = float(tan_half_y);
    basis.tan_half_x = float(tan_half_y * double(width) / double(height));
    return basis;
}

ManylightsView make_view(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const CameraBasis basis = camera_basis(camera, width, height);
    ManylightsView view{};
    view.size = sizeof(view);
    const glm::vec3 rows[3] = {basis.right, basis.up, -basis.forward};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) view.view_from_world[4 * column + row] = rows[row][column];
        view.view_from_world[12 + row] = -glm::dot(rows[row], camera.position);
    }
    view.view_from_world[15] = 1.0f;
    // w = depth = -z, and z / w = near / depth: 1 at the near plane, 0 at infinity.
    view.clip_from_view[0] = 1.0f / basis.tan_half_x;
    view.clip_from_view[5] = -1.0f / basis.tan_half_y;
    view.clip_from_view[11] = -1.0f;
    view.clip_from_view[14] = camera.near_plane;
    view.width = width;
    view.height = height;
    view.guard_px = 0.5f;
    return view;
}

} // namespace manylights::lab
