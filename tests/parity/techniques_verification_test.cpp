// The comparison that the proof rests on, without any device.

#include "lab/techniques/light_stream.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "reference/oracle/light_hash.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace manylights::lab {

namespace {

PixelRecord record_of(std::initializer_list<std::uint32_t> lights) {
    PixelRecord record{};
    record.shaded = 1;
    for (const std::uint32_t light : lights) {
        record.affecting += 1;
        record.hash_a += light_hash_a(light);
        record.hash_b += light_hash_b(light);
        record.radiance[0] += 1000 + light;
    }
    record.tested = 2 * record.affecting;
    return record;
}

std::vector<PixelRecord> image() { return {record_of({1, 2, 3}), PixelRecord{}, record_of({}), record_of({7, 8})}; }

} // namespace

TEST(Verification, equal_images_are_exact) {
    const VerifyResult result = compare(image(), image(), 2);
    EXPECT_TRUE(result.exact());
    EXPECT_EQ(result.pixels, 4u);
    EXPECT_EQ(result.shaded, 3u);
    EXPECT_FALSE(result.has_first_wrong);
}

TEST(Verification, work_may_differ) {
    std::vector<PixelRecord> got = image();
    got[0].tested += 5;
    got[0].nodes += 5;
    EXPECT_TRUE(compare(image(), got, 2).exact());
}

TEST(Verification, a_lost_light_is_a_missing_point_and_is_named) {
    std::vector<PixelRecord> got = image();
    got[3] = record_of({8});
    const VerifyResult result = compare(image(), got, 2);
    EXPECT_EQ(result.wrong_pixels, 1u);
    EXPECT_EQ(result.missing_points, 1u);
    EXPECT_EQ(result.first_x, 1u);
    EXPECT_EQ(result.first_y, 1u);
    const std::uint32_t affecting[] = {7, 8};
    EXPECT_EQ(missing_lights(result.first_truth, result.first_got, affecting), std::vector<std::uint32_t>{7});
    EXPECT_NE(light_set_hash(image()), light_set_hash(got));
}

TEST(Verification, two_lost_lights_are_named) {
    const std::uint32_t affecting[] = {1, 2, 3, 9};
    const std::vector<std::uint32_t> lost{1, 9};
    EXPECT_EQ(missing_lights(record_of({1, 2, 3, 9}), record_of({2, 3}), affecting), lost);
    EXPECT_TRUE(missing_lights(record_of({1, 2, 3, 9}), record_of({2}), affecting).empty());
}

TEST(Verification, a_replaced_light_is_a_missing_point) {
    std::vector<PixelRecord> got = image();
    got[0] = record_of({1, 2, 2});
    EXPECT_EQ(compare(image(), got, 4).missing_points, 1u);
}

TEST(Verification, a_light_handed_out_twice_is_wrong_and_not_missing) {
    std::vector<PixelRecord> got = image();
    got[0] = record_of({1, 2, 3, 3});
    const VerifyResult result = compare(image(), got, 4);
    EXPECT_EQ(result.wrong_pixels, 1u);
    EXPECT_EQ(result.missing_points, 0u);
}

TEST(Verification, front_sets_radiance_and_sky_count) {
    std::vector<PixelRecord> got = image();
    got[0].front_hash_b += 1;
    got[1].shaded = 1;
    got[3].radiance[2] += 1;
    const VerifyResult result = compare(image(), got, 4);
    EXPECT_EQ(result.wrong_pixels, 3u);
    EXPECT_EQ(result.wrong_radiance, 1u);
}

TEST(Verification, images_of_different_sizes_are_refused) {
    EXPECT_THROW(compare(image(), {}, 2), std::invalid_argument);
    EXPECT_THROW(compare(image(), image(), 3), std::invalid_argument);
    EXPECT_THROW(compare(image(), image(), 0), std::invalid_argument);
}

TEST(Summary, counts_the_shaded_pixels_only) {
    std::vector<PixelRecord> records(101);
    for (std::uint32_t i = 0; i < 100; ++i) {
        records[i].shaded = 1;
        records[i].tested = i + 1;
        records[i].affecting = 2;
    }
    records[100].tested = 5000;
    const WorkSummary work = summarize(records);
    EXPECT_EQ(work.shaded, 100u);
    EXPECT_DOUBLE_EQ(work.tested_mean, 50.5);
    EXPECT_EQ(work.tested_p95, 95u);
    EXPECT_EQ(work.tested_max, 100u);
    EXPECT_DOUBLE_EQ(work.affecting_mean, 2.0);
}

TEST(Summary, of_sky_alone_is_zero) {
    const WorkSummary work = summarize(std::vector<PixelRecord>(5));
    EXPECT_EQ(work.shaded, 0u);
    EXPECT_EQ(work.tested_mean, 0.0);
}

} // namespace manylights::lab
