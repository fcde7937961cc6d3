#include "lab/scene/truncated_normal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab {
namespace {

TEST(TruncatedNormal, InvertsTheDistributionFunction) {
    const double total = std::erf(2.0 / std::sqrt(2.0));
    for (int i = 0; i < 10'000; ++i) {
        const double u = (i + 0.37) / 10'000.0;
        const double back = 0.5 + 0.5 * std::erf(truncated_normal(u) / std::sqrt(2.0)) / total;
        ASSERT_NEAR(back, u, 3e-7);
    }
}

TEST(TruncatedNormal, StaysInsideTheCut) {
    EXPECT_NEAR(truncated_normal(0.0), -2.0, 1e-12);
    EXPECT_LE(truncated_normal(1.0 - 0x1p-53), 2.0);
    EXPECT_GT(truncated_normal(1.0 - 0x1p-53), 1.999);
    EXPECT_NEAR(truncated_normal(0.5), 0.0, 1e-12);
}

} // namespace
} // namespace manylights::lab
