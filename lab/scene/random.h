#pragma once
// Random numbers of scenes and lights: a hash of (seed, index, channel), so that any element can be had without the
// ones before it, and every machine has the same ones.

#include <cstdint>

namespace manylights::lab {

/// 64-bit finaliser of SplitMix (Steele, Lea, Flood 2014) over a packed counter: neighbouring counters are unrelated.
constexpr std::uint64_t hash_counter(std::uint32_t seed, std::uint32_t index, std::uint32_t channel) {
    std::uint64_t z = (std::uint64_t(seed) << 32 | index) + (std::uint64_t(channel) + 1) * 0x9e3779b97f4a7c15ull;
    for (int round = 0; round < 2; ++round) {
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ z >> 27) * 0x94d049bb133111ebull;
        z ^= z >> 31;
    }
    return z;
}

/// Uniform in [0, 1), a multiple of 2^-24: exact in float.
constexpr float random_unit(std::uint32_t seed, std::uint32_t index, std::uint32_t channel) {
    return float(hash_counter(seed, index, channel) >> 40) * 0x1p-24f;
}

/// Uniform in [0, 1), a multiple of 2^-53.
constexpr double random_unit_double(std::uint32_t seed, std::uint32_t index, std::uint32_t channel) {
    return double(hash_counter(seed, index, channel) >> 11) * 0x1p-53;
}

/// Uniform in [lower, upper].
constexpr float random_between(std::uint32_t seed, std::uint32_t index, std::uint32_t channel, float lower,
                               float upper) {
    return lower + (upper - lower) * random_unit(seed, index, channel);
}

} // namespace manylights::lab
