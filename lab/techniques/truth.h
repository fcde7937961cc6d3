#pragma once
// The right light sets of a view by the grid oracle, where brute force would take too long; and the proof, by plain
// brute force on some of the points, that the oracle is right itself.

#include "lab/techniques/point_lists.h"

#include <optional>

namespace manylights::lab {

/// The grid oracle's name where a technique could be named.
constexpr const char* kGridOracle = "grid";

/// What a technique's records must hold of each pixel's light sets, bit for bit as the device computes it. Radiance and
/// work are zero: they are not known here. positions and normals: of every pixel, row by row.
std::vector<PixelRecord> light_set_records(const Frame& frame, const PointLists& lists,
                                           std::span<const PointPosition> positions,
                                           std::span<const PointNormal> normals);

/// Of how many points of a view the lists are checked at the least, where it has so many.
constexpr std::size_t kCheckedPoints = 4096;

/// The pixels whose lists are checked, ascending: kCheckedPoints of those with a point, strewn over the image by a
/// hash; all of them where there are fewer.
std::vector<std::size_t> checked_pixels(std::span<const PointPosition> positions);

struct ListCheck {
    std::size_t points = 0;                 ///< checked
    std::optional<std::size_t> first_wrong; ///< the first pixel whose list is not what brute force finds
};

/// Asks every light at each of the checked pixels.
ListCheck check_lists(const Frame& frame, const PointLists& lists, std::span<const PointPosition> positions);

/// Test hook: takes a light out of the list of a pixel that is checked, so that a test can watch the check fail. False
/// where no such list has any.
bool remove_one_light(PointLists& lists, std::span<const PointPosition> positions);

} // namespace manylights::lab
