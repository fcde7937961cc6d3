// Damaged files of points are read or refused, and what is read is sound.

#include "lab/scene/random.h"
#include "tests/unit/points/made_points.h"

#include <gtest/gtest.h>

namespace manylights::lab {
namespace {

std::string mutant_of(std::string bytes, std::uint32_t seed, std::uint32_t i) {
    const std::uint32_t changes = 1 + std::uint32_t(4.0f * random_unit(seed, i, 0));
    for (std::uint32_t k = 0; k < changes; ++k) {
        const auto at = std::size_t(float(bytes.size()) * random_unit(seed, i, 3 * k + 1));
        bytes[at] = char(hash_counter(seed, i, 3 * k + 2) & 0xFFu);
    }
    return bytes;
}

TEST(PointFileFuzz, changed_bytes_are_refused_by_the_hash_or_before) {
    const std::string original = made_bytes();
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const std::string mutant = mutant_of(original, 11, i);
        if (mutant != original) {
            ASSERT_NE(refusal(mutant), "") << i;
        }
    }
}

TEST(PointFileFuzz, changed_bytes_under_a_new_hash_are_read_or_refused) {
    const std::string original = made_bytes();
    int accepted = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        SCOPED_TRACE(i);
        accepted += refusal(sealed(mutant_of(original, 12, i))).empty() ? 1 : 0;
    }
    EXPECT_GT(accepted, 100);
    EXPECT_LT(accepted, 3900);
}

TEST(PointFileFuzz, words_of_the_header_become_any_number) {
    const std::string original = made_bytes();
    int refused = 0;
    for (std::size_t at = 0; at < 76; at += 4)
        for (const std::uint32_t word :
             {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu, 0x7F800000u, 0x00000001u << 30}) {
            std::string mutant = original;
            for (std::size_t i = 0; i < 4; ++i) mutant[at + i] = char(word >> (8 * i));
            refused += refusal(sealed(mutant)).empty() ? 0 : 1;
        }
    EXPECT_GT(refused, 100);
}

TEST(PointFileFuzz, truncated_files_are_refused) {
    const std::string original = made_bytes();
    for (std::size_t length = 0; length < original.size(); ++length) {
        const std::string cut = original.substr(0, length);
        ASSERT_NE(refusal(cut), "") << length;
        if (length >= 8) {
            ASSERT_NE(refusal(sealed(cut)), "") << length;
        }
    }
}

} // namespace
} // namespace manylights::lab
