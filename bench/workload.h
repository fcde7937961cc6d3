#pragma once
// The lights and the camera of the build benchmarks: like the scene canyon, but without it, so that the benchmark needs
// nothing of the lab.

#include <manylights/manylights.h>

#include <cstdint>
#include <vector>

namespace manylights::bench {

/// Uniform in a box of 200 x 60 x 600 around the origin; radii 2 to 8, and 30 to 80 for 0.05%, times 0.94.
std::vector<ManylightsSphere> canyon_like_lights(std::uint32_t count);

/// Inside the box, near its end, looking along its axis: 60 degrees vertically, 1920 x 1080, reversed infinite depth.
ManylightsView canyon_like_view();

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres);

/// Clock frequency of this core in Hz now, from a chain of dependent additions, one per cycle.
double clock_hz();

} // namespace manylights::bench
