#pragma once
// What each point of a view should be shaded with, and nothing else.

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/technique.h"

namespace manylights::lab {

/// The lights that affect each point of a view, found by the grid oracle: one list per pixel, ascending; empty for sky.
struct PointLists {
    std::vector<std::uint64_t> first; ///< per pixel, and one behind the last
    std::vector<std::uint32_t> lights;

    std::span<const std::uint32_t> of(std::size_t pixel) const {
        return std::span(lights).subspan(first[pixel], first[pixel + 1] - first[pixel]);
    }
};

/// The most that all lists of a view may hold together: 4 GiB, and no machine is made to swap.
constexpr std::uint64_t kMostListedLights = std::uint64_t{1} << 30;

/// points: of every pixel of the frame, row by row. The lists do not depend on the number of threads (0: one per
/// processor). Throws InputError where they would hold more than `most` lights.
PointLists find_point_lists(const Frame& frame, std::span<const PointPosition> points, unsigned threads = 0,
                            std::uint64_t most = kMostListedLights);

} // namespace manylights::lab
