#pragma once
// The promise of manylights.h, spelled out: at which pixels and depths a light that affects a point must be handed out.

#include "reference/oracle/cases.h"
#include "tests/property/frame.h"

#include <vector>

namespace manylights::test {

/// Of all the pixels whose centre lies within guard_px of the position (in x and in y): the first and the last one of
/// each tile. The query looks at nothing finer than a tile, but for a rectangle in it, and what holds both ends of a
/// row holds all of it: so these stand for all. Centres, in pixels.
std::vector<MlFloat2> promised_pixels(const oracle::Camera& camera, std::uint32_t tile_px,
                                      oracle::ScreenPosition screen);

/// Floats within 2^-20 relative of the depth: the least, the nearest and the greatest.
std::vector<float> promised_depths(double depth);

bool is_promised_depth(float query_depth, double depth);

/// The point lies between the near and the far plane. Reconstruction and clipping round: so a little beyond the far
/// plane still counts, as much as clip z in float can be off.
bool is_between_planes(const oracle::Camera& camera, oracle::ScreenPosition screen);

/// What the checks of a test came to.
struct Outcome {
    std::uint64_t triples = 0; ///< (light, camera, point) in which the light affects the point, and a pixel is promised
    std::uint64_t lost = 0;    ///< of them: not handed out exactly once at one promised (pixel, depth) at least
    std::uint64_t queries = 0;
};

/// Asks the frame for a light that affects the point at all promised pixels and depths. extra_depths: further query
/// depths, each used if it is promised.
void check_triple(const Frame& frame, std::size_t view, const oracle::Camera& camera, MlFloat3 point,
                  std::uint32_t light, Outcome& outcome, const std::vector<float>& extra_depths = {});

/// The same for all lights that affect the point (as the oracle says).
void check_point(const Frame& frame, std::size_t view, const oracle::Camera& camera, MlFloat3 point,
                 const std::vector<std::uint32_t>& affecting, Outcome& outcome,
                 const std::vector<float>& extra_depths = {});

} // namespace manylights::test
