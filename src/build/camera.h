#pragma once
// What the library understands of a camera: where it is, how it is turned, and how depth and pixels follow from a
// point.

#include "manylights/manylights.h"
#include "src/format/report.h"

#include <cstdint>

namespace manylights::detail {

// Pixel position along one axis: origin + scale * (offset / depth), offset along the view axis, depth in front.
struct Axis {
    double scale; // pixels, not 0, negative where mirrored
    double origin;
    std::uint32_t size; // pixels
};

struct Camera {
    float position[3];      // world space, rounded once
    double rotation[3][3];  // rows: view x, view y, view depth (positive in front)
    double skew;            // how much lengths may change under the rotation, relative
    double position_extent; // largest |coordinate| of position
    double near_depth;      // points nearer are not promised anything; 0 where the projection does not say
    double far_depth;       // likewise beyond; +inf where the far plane is infinite or unknown
    double guard_px;
    Axis axes[2];
};

// index: the view's, for the report.
Outcome recognise_camera(const ManylightsView& view, std::uint32_t index, Camera& camera);

} // namespace manylights::detail
