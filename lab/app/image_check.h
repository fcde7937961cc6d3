#pragma once
// A shaded image against the one that the true records give.

#include "lab/techniques/technique.h"

#include <string>

namespace manylights::lab::app {

/// The linear radiance that the records hold in fixed point, RGB floats per pixel.
std::vector<float> radiance_of(const std::vector<PixelRecord>& records);

/// Empty where every value is finite and every tone-mapped 8-bit channel is within 1 of the truth's; else the first
/// pixel that is not, in words. mask: 1 per pixel with a surface.
std::string image_difference(std::span<const float> truth, std::span<const float> got,
                             std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height);

} // namespace manylights::lab::app
