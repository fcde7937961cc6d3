#include "lab/techniques/verification.h"

#include "reference/oracle/light_hash.h"

#include <algorithm>
#include <stdexcept>

namespace manylights::lab {

namespace {

bool same_light_sets(const PixelRecord& a, const PixelRecord& b) {
    return a.affecting == b.affecting && a.hash_a == b.hash_a && a.hash_b == b.hash_b && a.front == b.front &&
           a.front_hash_a == b.front_hash_a && a.front_hash_b == b.front_hash_b;
}

bool same_radiance(const PixelRecord& a, const PixelRecord& b) { return std::ranges::equal(a.radiance, b.radiance); }

// A bijection of 64-bit words: odd multiplications and xor-shifts only.
std::uint64_t mix(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9u;
    word = (word ^ (word >> 27)) * 0x94D049BB133111EBu;
    return word ^ (word >> 31);
}

std::uint64_t pair_of(std::uint32_t high, std::uint32_t low) { return std::uint64_t{high} << 32 | low; }

enum class Radiance { counts, does_not_count };

VerifyResult compare_pixels(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got,
                            std::uint32_t width, Radiance radiance) {
    if (truth.size() != got.size() || width == 0 || truth.size() % width != 0)
        throw std::invalid_argument("compare: records of images of different sizes");
    VerifyResult result;
    result.pixels = truth.size();
    for (std::size_t i = 0; i < truth.size(); ++i) {
        result.shaded += truth[i].shaded != 0;
        const bool sets_agree = same_light_sets(truth[i], got[i]);
        const bool radiance_agrees = radiance == Radiance::does_not_count || same_radiance(truth[i], got[i]);
        if (sets_agree && radiance_agrees && truth[i].shaded == got[i].shaded) continue;
        ++result.wrong_pixels;
        result.missing_points += !sets_agree && got[i].affecting <= truth[i].affecting;
        result.wrong_radiance += sets_agree && !radiance_agrees;
        if (result.has_first_wrong) continue;
        result.has_first_wrong = true;
        result.first_x = static_cast<std::uint32_t>(i % width);
        result.first_y = static_cast<std::uint32_t>(i / width);
        result.first_truth = truth[i];
        result.first_got = got[i];
    }
    return result;
}

} // namespace

VerifyResult compare(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got, std::uint32_t width) {
    return compare_pixels(truth, got, width, Radiance::counts);
}

VerifyResult compare_light_sets(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got,
                                std::uint32_t width) {
    return compare_pixels(truth, got, width, Radiance::does_not_count);
}

std::vector<std::uint32_t> missing_lights(const PixelRecord& truth, const PixelRecord& got,
                                          std::span<const std::uint32_t> affecting) {
    const std::uint32_t lost = truth.affecting - got.affecting;
    const std::uint32_t sum_a = truth.hash_a - got.hash_a;
    const std::uint32_t sum_b = truth.hash_b - got.hash_b;
    for (std::size_t i = 0; i < affecting.size(); ++i) {
        const std::uint32_t rest_a = sum_a - light_hash_a(affecting[i]);
        const std::uint32_t rest_b = sum_b - light_hash_b(affecting[i]);
        if (lost == 1 && rest_a == 0 && rest_b == 0) return {affecting[i]};
        for (std::size_t j = i + 1; lost == 2 && j < affecting.size(); ++j)
            if (rest_a == light_hash_a(affecting[j]) && rest_b == light_hash_b(affecting[j]))
                return {affecting[i], affecting[j]};
    }
    return {};
}

std::uint64_t light_set_hash(const std::vector<PixelRecord>& records) {
    std::uint64_t hash = mix(records.size());
    for (const PixelRecord& record : records) {
        hash = mix(hash + pair_of(record.affecting, record.front));
        hash = mix(hash + pair_of(record.hash_a, record.hash_b));
        hash = mix(hash + pair_of(record.front_hash_a, record.front_hash_b));
    }
    return hash;
}

} // namespace manylights::lab
