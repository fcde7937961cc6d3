#pragma once
// Saved points made by hand, and the bytes of their file for tests that damage them.

#include "lab/renderer/saved_points.h"

#include <string>

namespace manylights::lab {

constexpr std::size_t kMadeMaterials = 3;

/// Of a tilted camera; every third pixel is sky. Computed as point.glsl does.
SavedPoints made_points(float vertical_fov = 1.2f, std::uint32_t width = 7, std::uint32_t height = 5);

/// A file of this name in the tests' temporary folder.
std::string temporary_path(const std::string& name);
std::string bytes_of(const std::string& path);
std::string made_bytes(); ///< of the file with made_points
void write_text(const std::string& path, const std::string& bytes);

/// The last eight bytes become the hash of those before them: damage that the hash would not give away.
std::string sealed(std::string bytes);

/// What read_points says of a file with these bytes, without the path; empty where it reads them.
std::string refusal(const std::string& bytes);

} // namespace manylights::lab
