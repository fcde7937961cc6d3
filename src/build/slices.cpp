#include "src/build/slices.h"

#include <limits>

namespace manylights::detail {

namespace {

double power(double base, std::uint32_t exponent) {
    double result = 1.0;
    for (std::uint32_t i = 0; i < exponent; ++i) result *= base;
    return result;
}

// The largest double whose power does not exceed value >= 1, by bisection: multiplications round the same everywhere,
// std::pow does not.
double root(double value, std::uint32_t degree) {
    double low = 1.0;
    double high = value;
    for (;;) {
        const double middle = low + (high - low) * 0.5;
        if (!(middle > low && middle < high)) return low;
        (power(middle, degree) <= value ? low : high) = middle;
    }
}

// The logarithm of a positive double, bit by bit: squaring doubles it, so each squaring that passes 2 yields a one.
double log2_by_squaring(double value) {
    int exponent = 0;
    for (; value >= 2.0; value *= 0.5) ++exponent;
    for (; value < 1.0; value *= 2.0) --exponent;
    double result = exponent;
    for (double bit = 0.5; bit > 1e-15; bit *= 0.5) {
        value *= value;
        if (value < 2.0) continue;
        value *= 0.5;
        result += bit;
    }
    return result;
}

} // namespace

// Practical clustered shading (Persson 2013), with the slice formula of Tiled Light Trees, listing 4, corrected: the
// log range is divided by count - 1, not multiplied, so index = log(depth / near) / log(ratio) + 1, where
// ratio = (far / near)^(1 / (count - 1)). The logarithm is only the shader's guess; the edges decide.
Slices make_slices(std::uint32_t count, float near_edge, float far_edge) {
    Slices slices{};
    slices.count = count;
    slices.edges[count] = std::numeric_limits<float>::infinity();
    if (count == 1) return slices;

    const double first = near_edge;
    const double ratio = root(static_cast<double>(far_edge) / first, count - 1);
    double edge = first;
    for (std::uint32_t i = 1; i < count; ++i, edge *= ratio) slices.edges[i] = static_cast<float>(edge);

    // Where near and far almost meet the guess would leave the range of float; it is not needed there.
    const double log_ratio = log2_by_squaring(ratio);
    const double scale = log_ratio > 1e-6 ? 1.0 / log_ratio : 0.0;
    slices.scale = static_cast<float>(scale);
    slices.bias = static_cast<float>(1.0 - log2_by_squaring(first) * scale);
    return slices;
}

std::uint32_t slice_of(const Slices& slices, float depth) {
    std::uint32_t low = 0;
    std::uint32_t high = slices.count - 1;
    while (low < high) {
        const std::uint32_t middle = (low + high + 1) / 2;
        if (depth >= slices.edges[middle])
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

} // namespace manylights::detail
