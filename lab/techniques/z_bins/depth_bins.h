// Depth bins by arithmetic instead of a table of edges: one text for C++ (tests) and GLSL (the ends of lights in the
// build, the depths of points in shading). A bin never descends with the depth, on no device: one rounded product, or
// whole numbers. So a light's bins hold the bin of each depth between its ends.
#ifndef MANYLIGHTS_LAB_DEPTH_BINS_H
#define MANYLIGHTS_LAB_DEPTH_BINS_H

#include <manylights/format.h>

#if defined(__cplusplus)
#include <algorithm>
#include <bit>
#include <cstdint>
namespace manylights::lab {
inline std::uint32_t floatBitsToUint(float value) { return std::bit_cast<std::uint32_t>(value); }
#endif

struct DepthBins {
    MlUint count;
    float per_depth;     // linear: bins per unit of depth
    MlUint first_bits;   // log: bits of the depth where bin 1 begins
    MlUint bits_per_bin; // log: above 0
};

// Linear bins divide the depths from 0 on evenly. Log bins divide the bits of the depth evenly, which grow like its
// logarithm: exactly so at powers of two, in straight lines between them. The last bin is open.
ML_FN MlUint bin_of(DepthBins bins, float depth) {
    MlUint last = bins.count - 1u;
    if (bins.bits_per_bin != 0u) {
        if (!(depth > 0.0f) || floatBitsToUint(depth) < bins.first_bits) return 0u;
        MlUint bin = 1u + (floatBitsToUint(depth) - bins.first_bits) / bins.bits_per_bin;
        return bin < last ? bin : last;
    }
    float bin = depth * bins.per_depth;
    if (!(bin > 0.0f)) return 0u;
    return bin < float(last) ? MlUint(bin) : last; // compared before it is converted
}

#if defined(__cplusplus)
inline DepthBins linear_bins(std::uint32_t count, float far_depth) {
    return {count, static_cast<float>(count) / far_depth, 0, 0};
}

/// The first bin is open towards the camera, up to near_depth; the last one begins at far_depth or before.
inline DepthBins log_bins(std::uint32_t count, float near_depth, float far_depth) {
    const std::uint32_t first = floatBitsToUint(near_depth), end = floatBitsToUint(std::max(near_depth, far_depth));
    return {count, 0.0f, first, (end - first) / (count - 1) + 1};
}

} // namespace manylights::lab
#endif

#endif
