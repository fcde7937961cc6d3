#include "src/build/camera.h"

#include "src/format/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Element of a column-major matrix.
double at(const float* matrix, int row, int column) { return matrix[4 * column + row]; }

bool all_finite(const float* matrix) {
    return std::all_of(matrix, matrix + 16, [](float x) { return std::isfinite(x); });
}

Outcome bad_camera(const char* field, const char* rule, std::uint32_t index) {
    return {MANYLIGHTS_INVALID_CAMERA, field, rule, index};
}

// The Frobenius norm of R^T R - I. It bounds the spectral norm, so the singular values of R lie within
// sqrt(1 +- norm), and R changes lengths by at most that factor, relative.
double deviation_from_rotation(const double (&r)[3][3]) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double dot = r[0][i] * r[0][j] + r[1][i] * r[1][j] + r[2][i] * r[2][j];
            const double difference = dot - (i == j ? 1.0 : 0.0);
            sum += difference * difference;
        }
    }
    return std::sqrt(sum);
}

// Solves R p = -t by Cramer's rule; R is nearly a rotation, so its determinant is near 1 or -1.
void find_position(const double (&r)[3][3], const double (&t)[3], Camera& camera) {
    double cross[3][3]; // of rows: the columns of the adjugate
    for (int i = 0; i < 3; ++i) {
        const double* a = r[(i + 1) % 3];
        const double* b = r[(i + 2) % 3];
        cross[i][0] = a[1] * b[2] - a[2] * b[1];
        cross[i][1] = a[2] * b[0] - a[0] * b[2];
        cross[i][2] = a[0] * b[1] - a[1] * b[0];
    }
    const double determinant = r[0][0] * cross[0][0] + r[0][1] * cross[0][1] + r[0][2] * cross[0][2];
    camera.position_extent = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double sum = t[0] * cross[0][k] + t[1] * cross[1][k] + t[2] * cross[2][k];
        camera.position[k] = static_cast<float>(std::clamp(-sum / determinant, -3e38, 3e38));
        camera.position_extent = std::max(camera.position_extent, std::fabs(static_cast<double>(camera.position[k])));
    }
}

Outcome recognise_placement(const float* matrix, std::uint32_t index, Camera& camera) {
    constexpr const char* kField = "view.view_from_world";
    if (!all_finite(matrix)) return bad_camera(kField, "must be finite", index);
    if (at(matrix, 3, 0) != 0.0 || at(matrix, 3, 1) != 0.0 || at(matrix, 3, 2) != 0.0 || at(matrix, 3, 3) != 1.0)
        return bad_camera(kField, "must have the bottom row 0 0 0 1 (matrices are column-major)", index);
    double translation[3];
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) camera.rotation[row][column] = at(matrix, row, column);
        translation[row] = at(matrix, row, 3);
    }
    camera.skew = deviation_from_rotation(camera.rotation);
    if (!(camera.skew <= 1e-3))
        return bad_camera(kField, "must be a rotation (or a mirrored one) and a translation, without scale", index);
    find_position(camera.rotation, translation, camera);
    return {};
}

// Rows x, y and w of a perspective projection: w grows with view z alone, x and y have nothing but their own axis and
// an offset along z. Cross terms of 1e-7 are the rounding of a matrix product; they move no pixel by more than the
// widening of the bounds.
Outcome check_projection(const float* matrix, std::uint32_t index) {
    constexpr const char* kField = "view.clip_from_view";
    const auto tiny = [](double value, double against) { return std::fabs(value) <= 1e-7 * std::fabs(against); };
    if (!all_finite(matrix)) return bad_camera(kField, "must be finite", index);
    if (at(matrix, 3, 2) == 0.0 && at(matrix, 3, 3) != 0.0)
        return bad_camera(kField, "must be a perspective projection; orthographic ones are not served in this version",
                          index);
    const double w = at(matrix, 3, 2);
    if (w == 0.0 || !tiny(at(matrix, 3, 0), w) || !tiny(at(matrix, 3, 1), w) || at(matrix, 3, 3) != 0.0)
        return bad_camera(kField, "must have a bottom row of 0 0 w 0 (clip w depends on view z alone)", index);
    for (int row = 0; row < 2; ++row) {
        const double scale = at(matrix, row, row);
        if (!(std::fabs(scale / w) >= 1e-6 && std::fabs(scale / w) <= 1e6))
            return bad_camera(kField, "must scale x and y by a usable field of view", index);
        if (!(std::fabs(at(matrix, row, 2) / w) <= 1e6))
            return bad_camera(kField, "must have x and y offsets of at most a million images", index);
        if (!tiny(at(matrix, row, 1 - row), scale) || at(matrix, row, 3) != 0.0)
            return bad_camera(kField, "must keep x and y apart, and free of a constant", index);
    }
    return {};
}

// clip depth / w = (slope + constant / depth), so it takes the value v at the depth constant / (v - slope). Which of
// the planes -1, 0 and 1 are the near and the far one differs between conventions, and is not told. The nearest of
// them is not behind the true near plane and the farthest not before the true far plane: conservative for all. A
// rasteriser computes clip depth in float, so its far plane is only as sharp as the divisor's last bits.
void find_depth_planes(const float* matrix, double sign, Camera& camera) {
    camera.near_depth = 0.0;
    camera.far_depth = kInfinity;
    const double w = std::fabs(at(matrix, 3, 2));
    const double slope = at(matrix, 2, 2) * sign / w;
    const double constant = at(matrix, 2, 3) / w;
    if (at(matrix, 2, 0) != 0.0 || at(matrix, 2, 1) != 0.0 || constant == 0.0) return; // oblique or missing

    double nearest = kInfinity;
    double farthest = 0.0;
    for (const double plane : {-1.0, 0.0, 1.0}) {
        const double divisor = plane - slope;
        // Up to the rounding of its elements the matrix puts this plane at infinity.
        if (std::fabs(divisor) <= 1e-5 * std::max(1.0, std::fabs(slope))) {
            farthest = kInfinity;
            continue;
        }
        const double depth = constant / divisor;
        if (!(depth > 0.0)) continue;
        nearest = std::min(nearest, depth * (1.0 - 1e-3));
        farthest = std::max(farthest, depth * (1.0 + 1e-3 + 4e-7 / std::fabs(divisor)));
    }
    if (nearest < kInfinity) camera.near_depth = nearest;
    if (nearest < farthest) camera.far_depth = farthest;
}

} // namespace

Outcome recognise_camera(const ManylightsView& view, std::uint32_t index, Camera& camera) {
    if (!(view.width >= 1 && view.width <= kMaxPixels)) return invalid("view.width", "must be in [1, 65536]", index);
    if (!(view.height >= 1 && view.height <= kMaxPixels)) return invalid("view.height", "must be in [1, 65536]", index);
    if (!(view.guard_px >= 0.0f && view.guard_px <= 64.0f))
        return invalid("view.guard_px", "must be in [0, 64]", index);
    if (view.clip_y_up > 1) return invalid("view.clip_y_up", "must be 0 or 1", index);
    if (Outcome outcome = recognise_placement(view.view_from_world, index, camera); !outcome.ok()) return outcome;
    const float* clip = view.clip_from_view;
    if (Outcome outcome = check_projection(clip, index); !outcome.ok()) return outcome;

    // In front of the camera clip w is positive: depth = sign * view z. Then with x / w = (P00 * x / depth + sign *
    // P02) / |w|, and pixel = (ndc + 1) / 2 * size.
    const double w = std::fabs(at(clip, 3, 2));
    const double sign = at(clip, 3, 2) > 0.0 ? 1.0 : -1.0;
    for (double& element : camera.rotation[2]) element *= sign;
    const std::uint32_t size[2] = {view.width, view.height};
    for (int i = 0; i < 2; ++i) {
        const double flip = i == 1 && view.clip_y_up != 0 ? -1.0 : 1.0;
        const double half = 0.5 * size[i];
        camera.axes[i] = {flip * at(clip, i, i) / w * half, half + flip * sign * at(clip, i, 2) / w * half, size[i]};
    }
    camera.guard_px = view.guard_px;
    find_depth_planes(clip, sign, camera);
    return {};
}

} // namespace manylights::detail
