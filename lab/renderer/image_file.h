#pragma once
// Image files. A file is written under another name in the same folder and renamed when it is complete, so that nothing
// half-written is ever found under its name. All throw InputError naming the path and why.

#include "lab/renderer/tone_map.h"
#include "lab/renderer/unfinished_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace manylights::lab {

void write_png(const std::string& path, const Picture& picture);

/// Linear RGB floats per pixel, row by row, top row first; stored as 32-bit floats.
void write_exr(const std::string& path, std::span<const float> rgb, std::uint32_t width, std::uint32_t height);

struct FloatImage {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgb;
};
FloatImage read_exr(const std::string& path);

} // namespace manylights::lab
