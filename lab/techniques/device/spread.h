#pragma once
// More workgroups than an axis allows, in two axes: spread.glsl has their numbers.

#include <algorithm>
#include <array>
#include <cstdint>

namespace manylights::lab {

/// At least so many workgroups, none for 0; those behind the last have nothing to do.
inline std::array<std::uint32_t, 3> spread_groups(std::uint32_t groups) {
    const std::uint32_t across = std::clamp(groups, 1u, 32768u);
    return {across, groups / across + (groups % across != 0), 1};
}

} // namespace manylights::lab
