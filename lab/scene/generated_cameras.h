#pragma once

#include "lab/scene/scene.h"

namespace manylights::lab {

/// Fills up scene.cameras to four and sets scene.path, from the triangles alone: eye points inside the bounds with a
/// long free view that ends at a surface (rooms, streets), or, where there are none, views of the whole from outside.
void add_generated_cameras(Scene& scene);

} // namespace manylights::lab
