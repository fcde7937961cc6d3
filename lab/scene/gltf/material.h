#pragma once

#include "lab/scene/scene.h"

#include <tiny_gltf.h>

namespace manylights::lab::gltf {

/// Throws InputError for factors that are not finite.
Material convert_material(const std::string& path, const tinygltf::Model& model, std::size_t index);

} // namespace manylights::lab::gltf
