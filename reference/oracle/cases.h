#pragma once
// Cases made to break a culling structure: cameras of every convention, points on the edges of tiles and slices, and
// lights that reach a chosen point only just.

#include "reference/oracle/light_set.h"

namespace manylights::oracle {

struct CameraOptions {
    float largest_offset = 1e5f; ///< of the camera from the world's origin, along each axis
    std::uint32_t largest_edge_px = 2000;
};

/// Any camera that the library supports: looking down -z or +z, rotation mirrored or not, either sign of the projection
/// along x and y, off-centre or jittered, depth standard, reversed or OpenGL's, far plane finite or infinite.
Camera random_camera(Random& random, const CameraOptions& options = {});

/// A plain one: at `eye`, looking down -z with y up, reversed depth, no far plane, rows downwards.
Camera plain_camera(std::uint32_t width, std::uint32_t height, double tan_half_y, const float eye[3], float guard_px);

/// The same position, another direction and another projection.
Camera random_camera_at(Random& random, const float eye[3], const CameraOptions& options = {});

/// A light in world space whose float predicate accepts the point: its centre lies `distance` away in a random
/// direction, its range exceeds the real distance by `excess` relative, or by as little as the predicate allows where
/// excess is 0.
ManylightsSphere light_reaching(Random& random, const float eye[3], MlFloat3 point, double distance, double excess);

/// The least range, but not below 1e-15, with which a light at this camera-relative centre affects the point. They are
/// less than 1e19 apart, so that squares stay finite.
float least_range(MlFloat3 point, MlFloat3 center);

} // namespace manylights::oracle
