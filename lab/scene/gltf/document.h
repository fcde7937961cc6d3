#pragma once
// From a file's bytes to tinygltf's model, with everything refused on the way that its parser would trip over.

#include <tiny_gltf.h>

#include <string>

namespace manylights::lab::gltf {

/// Throws InputError. Images are left out: the lab reads no textures. Indices inside the model are not checked yet.
tinygltf::Model load_document(const std::string& path);

} // namespace manylights::lab::gltf
