#include "lab/app/number_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab::app {
namespace {

TEST(NumberScale, tops_are_round_and_never_below_the_value) {
    EXPECT_EQ(round_up_nicely(0.0), 1.0);
    EXPECT_EQ(round_up_nicely(1.0), 1.0);
    EXPECT_EQ(round_up_nicely(7.0), 8.0);
    EXPECT_EQ(round_up_nicely(100.0), 100.0);
    EXPECT_EQ(round_up_nicely(101.0), 120.0);
    EXPECT_EQ(round_up_nicely(65536.0), 80000.0);
    EXPECT_EQ(round_up_nicely(NAN), 1.0);
    for (double value = 1.0; value < 3000.0; value *= 1.01) {
        EXPECT_GE(round_up_nicely(value), value);
        EXPECT_LE(round_up_nicely(value), 1.34 * value);
    }
}

TEST(NumberScale, ticks_start_at_zero_are_few_enough_and_step_by_one_two_or_five) {
    EXPECT_EQ(tick_values(120.0, 6), (std::vector<double>{0, 20, 40, 60, 80, 100, 120}));
    EXPECT_EQ(tick_values(5.0, 5), (std::vector<double>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(tick_values(0.0, 5), (std::vector<double>{0}));
    for (double top = 1.0; top < 100000.0; top *= 1.07) {
        for (int most = 1; most <= 10; ++most) {
            const std::vector<double> ticks = tick_values(top, most);
            ASSERT_LE(ticks.size(), static_cast<std::size_t>(most) + 1) << top;
            EXPECT_LE(ticks.back(), top * (1.0 + 1e-9));
            if (ticks.size() < 2) continue;
            const double mantissa = ticks[1] / std::pow(10.0, std::floor(std::log10(ticks[1] * (1.0 + 1e-12))));
            EXPECT_TRUE(std::abs(mantissa - 1.0) < 1e-9 || std::abs(mantissa - 2.0) < 1e-9 ||
                        std::abs(mantissa - 5.0) < 1e-9)
                << mantissa;
        }
    }
}

TEST(NumberScale, percentile_is_the_nearest_rank) {
    std::vector<float> values;
    for (int i = 100; i >= 1; --i) values.push_back(static_cast<float>(i));
    EXPECT_EQ(percentile(values, 0.99), 99.0);
    EXPECT_EQ(percentile(values, 0.5), 50.0);
    EXPECT_EQ(percentile(values, 1.0), 100.0);
    EXPECT_EQ(percentile(values, 0.0), 1.0);
    EXPECT_EQ(percentile({}, 0.5), 0.0);
}

TEST(NumberScale, numbers_read_at_a_glance) {
    EXPECT_EQ(with_separators(0), "0");
    EXPECT_EQ(with_separators(999), "999");
    EXPECT_EQ(with_separators(65536), "65,536");
    EXPECT_EQ(with_separators(16777216), "16,777,216");
    EXPECT_EQ(short_number(3.0), "3");
    EXPECT_EQ(short_number(0.416), "0.42");
    EXPECT_EQ(short_number(31.24), "31.2");
    EXPECT_EQ(short_number(163.7), "164");
    EXPECT_EQ(short_number(65536.0), "65,536");
}

} // namespace
} // namespace manylights::lab::app
