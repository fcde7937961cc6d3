#pragma once
// What a camera does to a point, in double precision and written for clarity: the truth that the library is held to.
//
// Points are camera-relative: world position minus camera position, rounded once to float, along the world's axes.

#include "reference/oracle/random.h"

#include <manylights/format.h>
#include <manylights/manylights.h>

namespace manylights::oracle {

struct Camera {
    ManylightsView view{};
    float eye[3]{};            ///< world space: what points and lights are made relative to
    double near_depth = 0.1;   ///< view depth of the near plane, as clip_from_view has it
    double far_depth = 1000.0; ///< of the far plane; +inf where there is none
};

/// Where a point is in the image: pixels and view depth. depth <= 0: behind the camera, and x and y mean nothing.
struct ScreenPosition {
    double x, y, depth;
};

inline Double3 to_double(MlFloat3 v) { return {v.x, v.y, v.z}; }
inline MlFloat3 to_float(Double3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// World position minus camera position, each difference rounded once.
inline MlFloat3 camera_relative(const float world[3], const float eye[3]) {
    return {world[0] - eye[0], world[1] - eye[1], world[2] - eye[2]};
}

/// Camera-relative (along the world's axes) to view space: the rotation of view_from_world alone.
Double3 view_from_relative(const Camera& camera, Double3 relative);
Double3 relative_from_view(const Camera& camera, Double3 view_space);

/// World space to view space by the whole matrix: for renderers that shade in world space.
Double3 view_from_world(const Camera& camera, const float world[3]);

ScreenPosition project_view_space(const Camera& camera, Double3 view_space);
ScreenPosition project(const Camera& camera, MlFloat3 relative);

/// The view-space point at a pixel position and a view depth; exact up to double rounding.
Double3 unproject_view_space(const Camera& camera, ScreenPosition screen);
/// The camera-relative point nearest to it.
MlFloat3 unproject(const Camera& camera, ScreenPosition screen);

/// Of the camera-relative points within one unit in the last place of unproject(screen), the one whose projection is
/// closest to screen along x.
MlFloat3 unproject_precisely_along_x(const Camera& camera, ScreenPosition screen);
MlFloat3 unproject_precisely_along_y(const Camera& camera, ScreenPosition screen);

} // namespace manylights::oracle
