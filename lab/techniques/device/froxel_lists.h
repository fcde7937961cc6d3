#pragma once
// Shading through lists of froxels. The structure's buffers are the froxel grid's and, of contiguous lists, TileLists'
// cells and references, or TileLinks' heads and links.

#include "lab/techniques/shading_pass.h"

namespace manylights::lab {

/// name: the technique's.
PassShaders froxel_list_shaders(const std::string& name);
PassShaders froxel_link_shaders(const std::string& name);

} // namespace manylights::lab
