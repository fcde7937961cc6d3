#pragma once

#include "lab/scene/scene.h"

namespace manylights::lab {

/// A .glb or .gltf file. Read: triangles (also strips and fans), node transforms, base colour, roughness, metalness and
/// emission factors, perspective cameras, KHR_lights_punctual point lights. Left out: textures, skins, morphing,
/// animation, orthographic cameras, spot and directional lights. Throws InputError.
Scene load_gltf(const std::string& path);

} // namespace manylights::lab
