#include "lab/app/remaining_time.h"

#include <gtest/gtest.h>

namespace manylights::lab::app {
namespace {

TEST(RemainingTime, is_what_the_rest_takes_at_the_pace_so_far) {
    RemainingTime time;
    for (const double weight : {1.0, 1.0, 4.0}) time.expect(weight);
    EXPECT_EQ(time.text(10.0), "?");
    time.done(1.0);
    EXPECT_EQ(time.text(10.0), "50 s");
    time.done(1.0);
    EXPECT_EQ(time.text(60.0), "2 min");
    time.done(4.0);
    EXPECT_EQ(time.text(100.0), "0 s");
}

} // namespace
} // namespace manylights::lab::app
