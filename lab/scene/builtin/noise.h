#pragma once
// Smooth value noise over the hash of random.h: the shapes of the built-in scenes, without a maths library.

#include "lab/scene/random.h"

namespace manylights::lab {

constexpr int floor_to_int(float x) {
    const int i = int(x);
    return float(i) > x ? i - 1 : i;
}

constexpr float smooth_step(float t) { return t * t * (3.0f - 2.0f * t); }

/// In [0, 1), with period-free features of length 1.
constexpr float value_noise(std::uint32_t seed, float x) {
    const int i = floor_to_int(x);
    const float t = smooth_step(x - float(i));
    return random_unit(seed, std::uint32_t(i), 0) * (1.0f - t) + random_unit(seed, std::uint32_t(i + 1), 0) * t;
}

constexpr float value_noise(std::uint32_t seed, float x, float y) {
    const int i = floor_to_int(y);
    const float t = smooth_step(y - float(i));
    const auto row = [&](int r) { return value_noise(seed + 7919u * std::uint32_t(r), x); };
    return row(i) * (1.0f - t) + row(i + 1) * t;
}

} // namespace manylights::lab
