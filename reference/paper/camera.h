#pragma once
// The camera as the pipeline's stages need it: axes that point along pixel columns, pixel rows and depth.

#include <manylights/manylights.h>

#include <cstdint>

namespace manylights::paper {

struct Camera {
    float position[3];         ///< world space
    float position_slack;      ///< what the position and world coordinates near it may be off by, in world units
    float right_from_world[3]; ///< unit length, towards growing pixel columns
    float down_from_world[3];  ///< towards growing pixel rows
    float depth_from_world[3]; ///< towards growing view depth
    float scale_x, scale_y;    ///< pixels per unit of x / depth and y / depth, > 0
    float center_x, center_y;  ///< where x / depth = 0 and y / depth = 0 land, in pixels
    float near_depth;          ///< no promised point is nearer
    std::uint32_t width, height;
    float guard_px;
};

/// Throws std::invalid_argument naming the field: only perspective projections, as the paper has.
Camera read_camera(const ManylightsView& view);

} // namespace manylights::paper
