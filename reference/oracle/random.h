#pragma once
// Random numbers for tests: integer hashes and exact arithmetic only, so that every machine draws the same ones.

#include <cmath>
#include <cstdint>

namespace manylights::oracle {

struct Double3 {
    double x, y, z;
};

inline Double3 operator+(Double3 a, Double3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 operator-(Double3 a, Double3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator*(Double3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Double3 a, Double3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Double3 a) { return std::sqrt(dot(a, a)); }

/// A counter run through a bijective mix of 64-bit words (xor-shifts and odd multiplications).
class Random {
  public:
    explicit Random(std::uint64_t seed) : counter_(seed * 0xD1342543DE82EF95u) {}

    std::uint64_t bits() {
        counter_ += 0x9E3779B97F4A7C15u;
        std::uint64_t h = counter_;
        h = (h ^ (h >> 30u)) * 0xBF58476D1CE4E5B9u;
        h = (h ^ (h >> 27u)) * 0x94D049BB133111EBu;
        return h ^ (h >> 31u);
    }

    /// [0, 1), 53 bits.
    double unit() { return std::ldexp(static_cast<double>(bits() >> 11u), -53); }
    /// [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// [0, count); count is small against 2^64, so the bias does not show.
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(bits() % count); }
    /// [first, last].
    int integer(int first, int last) {
        return first + static_cast<int>(below(static_cast<std::uint32_t>(last - first + 1)));
    }
    bool chance(double probability) { return unit() < probability; }
    double sign() { return chance(0.5) ? 1.0 : -1.0; }
    /// [2^low, 2^(high + 1)), each octave equally often.
    double octaves(int low, int high) { return std::ldexp(1.0 + unit(), integer(low, high)); }

    /// Uniform on the unit sphere: a point of the unit ball, normalised.
    Double3 direction() {
        for (;;) {
            Double3 v{between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
            double squared = dot(v, v);
            if (squared > 1e-4 && squared <= 1.0) return v * (1.0 / std::sqrt(squared));
        }
    }

  private:
    std::uint64_t counter_;
};

} // namespace manylights::oracle
