#pragma once
// The proof: a technique's records against the truth, brute force's or the grid oracle's (truth.h), pixel by pixel and
// bit by bit. No tolerance.

#include "lab/techniques/technique.h"

#include <cstddef>

namespace manylights::lab {

struct VerifyResult {
    std::uint64_t pixels = 0;
    std::uint64_t shaded = 0;         ///< pixels that the truth shades
    std::uint64_t wrong_pixels = 0;   ///< any difference: light sets, radiance, or what counts as sky
    std::uint64_t missing_points = 0; ///< pixels whose light set differs otherwise than by a light handed out twice
    std::uint64_t wrong_radiance = 0; ///< pixels whose light sets agree and whose radiance does not
    bool has_first_wrong = false;     ///< the fields below hold the first wrong pixel, in row order
    std::uint32_t first_x = 0, first_y = 0;
    PixelRecord first_truth{}, first_got{};

    bool exact() const { return wrong_pixels == 0; }
};

/// Radiance is comparable between records of the same device only. Throws std::invalid_argument where the sizes differ,
/// which is a mistake of the caller.
VerifyResult compare(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got, std::uint32_t width);

/// The same without the radiance: for a truth that knows none.
VerifyResult compare_light_sets(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got,
                                std::uint32_t width);

/// Which lights the technique lost at a pixel: those of the affecting lights (light_stream.h) whose hashes explain the
/// difference of the two records. One or two lost lights are found; empty where there are more, or none.
std::vector<std::uint32_t> missing_lights(const PixelRecord& truth, const PixelRecord& got,
                                          std::span<const std::uint32_t> affecting);

/// One number for the light sets of a whole image, front sets included: equal where every pixel's sets are equal.
std::uint64_t light_set_hash(const std::vector<PixelRecord>& records);

} // namespace manylights::lab
