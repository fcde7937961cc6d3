#pragma once
// Typed, bounds-checked reading of glTF accessors: strided, sparse, normalized.

#include <tiny_gltf.h>

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace manylights::lab::gltf {

/// The elements of a VEC3 accessor of floats, or of (normalized or plain) integers. Throws InputError.
std::vector<glm::vec3> read_vectors(const std::string& path, const tinygltf::Model& model, int accessor);

/// The elements of a SCALAR accessor of unsigned 8, 16 or 32-bit integers. Throws InputError.
std::vector<std::uint32_t> read_indices(const std::string& path, const tinygltf::Model& model, int accessor);

} // namespace manylights::lab::gltf
