#pragma once
// Which lanes of a vector are kept, side by side.

#include <cstdint>

namespace manylights::detail {

// Of each mask of eight lanes: 4 bits per kept lane, its number, in ascending order from the lowest bits on; then
// zeros.
struct LaneOrders {
    std::uint32_t of[256];
};

constexpr LaneOrders make_lane_orders() {
    LaneOrders orders{};
    for (std::uint32_t mask = 0; mask < 256; ++mask) {
        std::uint32_t kept = 0;
        for (std::uint32_t lane = 0; lane < 8; ++lane)
            if ((mask >> lane & 1) != 0) orders.of[mask] |= lane << (4 * kept++);
    }
    return orders;
}

inline constexpr LaneOrders kLaneOrders = make_lane_orders();

} // namespace manylights::detail
