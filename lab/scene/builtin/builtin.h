#pragma once
// The built-in procedural scenes. Sizes and contents are those of the project's reference measurements, so that
// figures compare.

#include "lab/scene/scene.h"

namespace manylights::lab {

Scene make_canyon(Detail detail);
Scene make_citadel(Detail detail);
Scene make_bars(Detail detail);
Scene make_cornell(Detail detail);
Scene make_blocktown(Detail detail);

} // namespace manylights::lab
