#pragma once
// Saved points in a file, so that they travel between machines.
//
//   bytes          what
//   8              the letters MLPOINTS
//   4              version: 1
//   4, 4           width, height
//   4              number of points n
//   4, 4           lengths of the scene's and the camera's name, s and c
//   44             camera: position, forward, up (3 floats each), vertical field of view, near plane
//   s, c           the names
//   n times 36     pixel, position (3 floats), view depth, normal (3 floats), material
//   8              FNV-1a, 64 bits, of every byte before it
//
// Numbers are little-endian, whole ones without a sign, floats of 32 bits. No gaps. Pixels without a point are sky.

#include "lab/renderer/saved_points.h"

namespace manylights::lab {

/// Complete or not at all. Throws InputError naming the path and why, also for points that read_points would refuse.
void write_points(const std::string& path, const SavedPoints& saved, std::size_t material_count);

/// scene: the name of the one that the points must be of; material_count: its materials. Throws InputError naming the
/// path, the field and the rule.
SavedPoints read_points(const std::string& path, const std::string& scene, std::size_t material_count);

} // namespace manylights::lab
