#pragma once

#include "lab/scene/scene.h"

#include <tiny_gltf.h>

namespace manylights::lab::gltf {

/// Adds the triangles of one mesh, moved by world_from_mesh, to the scene. Triangles without area are left out. Throws
/// InputError.
void append_mesh(const std::string& path, const tinygltf::Model& model, std::size_t mesh,
                 const glm::dmat4& world_from_mesh, Scene& scene);

} // namespace manylights::lab::gltf
