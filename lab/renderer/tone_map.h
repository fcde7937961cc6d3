#pragma once
// From linear radiance to pixels of a picture: ambient light, automatic exposure, a filmic curve, sRGB. On the CPU, the
// same for every technique.

#include <cstdint>
#include <span>
#include <vector>

namespace manylights::lab {

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb; ///< sRGB, row by row, top row first
};

/// The exposure that puts the log-average luminance of the shaded pixels at middle grey, or less where that would burn
/// out more than 2% of them. Sky and black pixels do not count; 1 where nothing is left. shaded: one element per pixel,
/// 0 is sky.
float auto_exposure(std::span<const float> radiance, std::span<const std::uint8_t> shaded);

/// radiance: linear RGB per pixel. Sky pixels become a gradient that is dark at the top; the others are exposed and
/// tone mapped. exposure 0: auto_exposure.
Picture tone_map(std::span<const float> radiance, std::span<const std::uint8_t> shaded, std::uint32_t width,
                 std::uint32_t height, float exposure = 0.0f);

} // namespace manylights::lab
