#include "reference/paper/slices.h"

#include <cmath>
#include <stdexcept>

namespace manylights::paper {
namespace {

double power(double base, std::uint32_t exponent) {
    double result = 1.0;
    for (std::uint32_t i = 0; i < exponent; ++i) result *= base;
    return result;
}

// The positive root of q^degree = value, for value > 1, by bisection: products only, so that the edges come out the
// same on every machine.
double root(double value, std::uint32_t degree) {
    double below = 1.0, above = value;
    for (int step = 0; step < 128; ++step) {
        const double middle = 0.5 * (below + above);
        (power(middle, degree) < value ? below : above) = middle;
    }
    return below;
}

} // namespace

void SliceTable::update(const Options& options, std::uint32_t slice_count) {
    if (slice_count == count_ && options.slice_near == near_ && options.slice_far == far_ &&
        options.slice_formula == formula_)
        return;
    if (slice_count < 1 || slice_count > 128 || !(options.slice_near > 0.0f) ||
        !(options.slice_far > options.slice_near) || !std::isfinite(options.slice_far))
        throw std::invalid_argument("slice_count must be in [1, 128] and 0 < slice_near < slice_far");
    count_ = slice_count;
    near_ = options.slice_near;
    far_ = options.slice_far;
    formula_ = options.slice_formula;
    fill_edges(near_, far_, formula_);
    fill_bins();
}

// With x = log(depth / near) / log(far / near), the slice is floor(1 + x (count - 1)) as the slides have it, and
// floor(1 + x / (count - 1)) as listing 4 prints it. Edge i is where the bracket reaches i:
//     corrected  near * (far / near)^((i - 1) / (count - 1))
//     printed    near * (far / near)^((i - 1) * (count - 1))     beyond the range of float from i = 3 on for the
//     paper's
//                                                                numbers: those slices are empty
void SliceTable::fill_edges(double near_edge, double far_edge, SliceFormula formula) {
    edges_.assign(count_ + 1, std::numeric_limits<float>::infinity());
    edges_[0] = 0.0f;
    guess_scale_ = guess_bias_ = 0.0f;
    if (count_ == 1) return;
    const bool printed = formula == SliceFormula::listing4_as_printed;
    const double ratio = far_edge / near_edge;
    const double step = printed ? power(ratio, count_ - 1) : root(ratio, count_ - 1);
    double edge = near_edge;
    for (std::uint32_t i = 1; i < count_; ++i, edge *= step)
        edges_[i] = edge <= kLargest ? float(edge) : std::numeric_limits<float>::infinity();
    const double intervals = count_ - 1;
    const double scale = (printed ? 1.0 / intervals : intervals) / std::log2(ratio);
    guess_scale_ = float(scale);
    guess_bias_ = float(1.0 - std::log2(near_edge) * scale);
}

void SliceTable::fill_bins() {
    std::uint32_t slice = 0;
    for (std::uint32_t bin = 0; bin < kBinCount; ++bin) {
        const float smallest = std::bit_cast<float>(bin << kBinShift);
        while (slice + 1 < count_ && smallest >= edges_[slice + 1]) ++slice;
        first_slice_[bin] = std::uint8_t(slice);
    }
}

} // namespace manylights::paper
