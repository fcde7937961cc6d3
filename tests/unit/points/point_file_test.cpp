// Files of points: what is written is read again, in the layout that the header draws, and nothing bad is read.

#include "lab/renderer/point_file.h"

#include "lab/scene/error.h"
#include "tests/unit/points/made_points.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

namespace manylights::lab {
namespace {

namespace fs = std::filesystem;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

// Offsets of the drawn layout; the names "made" and "tilted" are 10 bytes.
constexpr std::size_t kVersion = 8, kWidth = 12, kHeight = 16, kCount = 20, kSceneLength = 24, kCameraLength = 28;
constexpr std::size_t kForward = 44, kUp = 56, kFov = 68, kNear = 72, kNames = 76, kFirstPoint = 86;
constexpr std::size_t kPosition = 4, kDepth = 16, kNormal = 20, kMaterial = 32, kPointBytes = 36;

std::size_t field_of(std::size_t point, std::size_t field) { return kFirstPoint + point * kPointBytes + field; }

std::string with_word(std::string bytes, std::size_t offset, std::uint32_t word) {
    for (std::size_t i = 0; i < 4; ++i) bytes.at(offset + i) = static_cast<char>(word >> (8 * i));
    return sealed(bytes);
}

std::string with_number(const std::string& bytes, std::size_t offset, float value) {
    return with_word(bytes, offset, std::bit_cast<std::uint32_t>(value));
}

TEST(PointFile, what_is_written_is_read) {
    const std::string path = temporary_path("round_trip");
    const SavedPoints made = made_points();
    write_points(path, made, kMadeMaterials);
    const SavedPoints read = read_points(path, "made", kMadeMaterials);
    EXPECT_EQ(read.scene, "made");
    EXPECT_EQ(read.camera.name, "tilted");
    EXPECT_EQ(read.camera.position, made.camera.position);
    EXPECT_EQ(read.camera.forward, made.camera.forward);
    EXPECT_EQ(read.camera.up, made.camera.up);
    EXPECT_EQ(read.camera.vertical_fov, made.camera.vertical_fov);
    EXPECT_EQ(read.camera.near_plane, made.camera.near_plane);
    EXPECT_EQ(read.width, 7u);
    EXPECT_EQ(read.height, 5u);
    EXPECT_EQ(read.points, made.points);
    fs::remove(path);
}

TEST(PointFile, has_the_layout_that_is_drawn) {
    const std::string bytes = made_bytes();
    ASSERT_EQ(bytes.size(), kFirstPoint + 24 * kPointBytes + 8);
    EXPECT_EQ(bytes.substr(0, 8), "MLPOINTS");
    EXPECT_EQ(bytes.substr(kVersion, 12), std::string("\1\0\0\0\7\0\0\0\5\0\0\0", 12));
    EXPECT_EQ(bytes.substr(kCount, 12), std::string("\30\0\0\0\4\0\0\0\6\0\0\0", 12));
    EXPECT_EQ(bytes.substr(kNear, 4), std::string("\0\0\x80\x3e", 4)) << "0.25";
    EXPECT_EQ(bytes.substr(kNames, 10), "madetilted");
    EXPECT_EQ(bytes.substr(field_of(2, 0), 4), std::string("\3\0\0\0", 4)) << "pixel 2 is sky";
    EXPECT_EQ(bytes.substr(field_of(1, kMaterial), 4), std::string("\1\0\0\0", 4));
    EXPECT_EQ(sealed(bytes), bytes);
}

TEST(PointFile, an_image_of_sky_has_no_points) {
    SavedPoints made = made_points();
    made.points.clear();
    const std::string path = temporary_path("sky");
    write_points(path, made, 1);
    EXPECT_TRUE(read_points(path, "made", 1).points.empty());
    fs::remove(path);
}

TEST(PointFile, what_is_no_file_of_points_is_refused) {
    const std::string bytes = made_bytes();
    EXPECT_EQ(refusal(""), "length: must be at least 84 bytes, is 0");
    EXPECT_EQ(refusal(bytes.substr(0, 83)), "length: must be at least 84 bytes, is 83");
    EXPECT_EQ(refusal(bytes.substr(0, bytes.size() - 1)), "length: must be 958 bytes by its header, is 957");
    EXPECT_EQ(refusal(bytes + '\0'), "length: must be 958 bytes by its header, is 959");
    EXPECT_EQ(refusal("x" + bytes.substr(1)), "magic: must be MLPOINTS: this is no file of points");
    EXPECT_EQ(refusal(with_word(bytes, kVersion, 2)), "version 2: must be 1");
    std::string damaged = bytes;
    damaged[field_of(5, kNormal)] ^= 1;
    EXPECT_EQ(refusal(damaged), "hash: must be that of the bytes before it: the file is damaged");
    damaged = bytes;
    damaged.back() ^= 1;
    EXPECT_EQ(refusal(damaged), "hash: must be that of the bytes before it: the file is damaged");
}

TEST(PointFile, sizes_that_the_file_has_not_are_refused_before_anything_is_allocated) {
    const std::string bytes = made_bytes();
    EXPECT_EQ(refusal(with_word(bytes, kCount, 0xFFFFFFFFu)),
              "length: must be 154618822714 bytes by its header, is 958");
    EXPECT_EQ(refusal(with_word(bytes, kSceneLength, 0xFFFFFFFFu)),
              "length: must be 4294968249 bytes by its header, is 958");
    EXPECT_EQ(refusal(with_word(bytes, kCameraLength, 5)), "length: must be 957 bytes by its header, is 958");
}

struct BadNumber {
    std::size_t offset;
    float value;
    const char* rule;
};

TEST(PointFile, numbers_that_break_a_rule_are_refused) {
    const std::string bytes = made_bytes();
    const std::size_t x = field_of(4, kPosition), depth = field_of(4, kDepth), normal = field_of(4, kNormal);
    const BadNumber bad_numbers[] = {{32, kNan, "camera position: must be finite"},
                                     {kForward, 1.0f, "camera forward: must have the length 1"},
                                     {kUp, kInfinity, "camera up: must be finite and not zero"},
                                     {kUp + 4, 0.0f, "camera up: must be finite and not zero"},
                                     {kFov, 0.0f, "camera field of view: must be from 0.01 to 3 radians"},
                                     {kFov, 3.1f, "camera field of view: must be from 0.01 to 3 radians"},
                                     {kFov, kNan, "camera field of view: must be from 0.01 to 3 radians"},
                                     {kNear, 0.0f, "camera near plane: must be above 0, at most 1e6"},
                                     {kNear, kInfinity, "camera near plane: must be above 0, at most 1e6"},
                                     {x, kInfinity, "point of pixel 6: position: must be finite"},
                                     {x + 8, kNan, "point of pixel 6: position: must be finite"},
                                     {depth, 0.0f, "point of pixel 6: depth: must be above 0 and below 1e18"},
                                     {depth, -1.0f, "point of pixel 6: depth: must be above 0 and below 1e18"},
                                     {depth, kInfinity, "point of pixel 6: depth: must be above 0 and below 1e18"},
                                     {depth, kNan, "point of pixel 6: depth: must be above 0 and below 1e18"},
                                     {normal + 4, 0.602f, "point of pixel 6: normal: must have the length 1"},
                                     {normal + 4, 0.598f, "point of pixel 6: normal: must have the length 1"},
                                     {normal, kNan, "point of pixel 6: normal: must have the length 1"},
                                     {kNear, 0.26f, "point of pixel 0: depth: must not be before the near plane"}};
    for (const BadNumber& bad : bad_numbers) EXPECT_EQ(refusal(with_number(bytes, bad.offset, bad.value)), bad.rule);
    EXPECT_EQ(refusal(with_number(bytes, normal + 4, 0.601f)), "");
}

TEST(PointFile, whole_numbers_that_break_a_rule_are_refused) {
    const std::string bytes = made_bytes();
    EXPECT_EQ(refusal(with_word(bytes, kWidth, 0)), "width 0: must be from 1 to 8192");
    EXPECT_EQ(refusal(with_word(bytes, kWidth, 8193)), "width 8193: must be from 1 to 8192");
    EXPECT_EQ(refusal(with_word(bytes, kHeight, 0xFFFFFFFFu)), "height 4294967295: must be from 1 to 8192");
    EXPECT_EQ(refusal(with_word(bytes, kHeight, 4)), "point 19: pixel 28: must be below 28");
    EXPECT_EQ(refusal(with_word(bytes, field_of(4, 0), 4)), "point 4: pixel 4: must be above the one before");
    EXPECT_EQ(refusal(with_word(bytes, field_of(23, 0), 35)), "point 23: pixel 35: must be below 35");
    EXPECT_EQ(refusal(with_word(bytes, field_of(4, kMaterial), 3)),
              "point of pixel 6: material 3: must be below 3, the scene's number of them");
}

TEST(PointFile, names_that_cannot_be_printed_and_other_scenes_are_refused) {
    const std::string bytes = made_bytes();
    const std::string end_of_line = with_word(bytes, kNames, 0x65640A6Du);
    EXPECT_EQ(refusal(end_of_line), "scene name: must have no control characters");
    std::string long_name = bytes;
    long_name.insert(kNames, 1021, 'x');
    EXPECT_EQ(refusal(with_word(bytes, kNames, 0x6564616Cu)), "scene 'lade': must be 'made', the one selected");
    EXPECT_EQ(refusal(with_word(long_name, kSceneLength, 1025)), "scene name: must be at most 1024 bytes long");
}

/// What is said of the points when one of them is changed.
std::string rule_for(std::size_t point, const std::function<void(SavedPoint&, const CameraBasis&)>& change) {
    SavedPoints made = made_points();
    change(made.points.at(point), camera_basis(made.camera, made.width, made.height));
    return broken_rule(made);
}

// 7 pixels span 2 tan_half_x at depth 1.
std::string rule_for_shift(float pixels_right, float pixels_down) {
    return rule_for(9, [&](SavedPoint& point, const CameraBasis& basis) {
        point.position += basis.right * (pixels_right * 2.0f / 7.0f * basis.tan_half_x * point.depth);
        point.position -= basis.up * (pixels_down * 2.0f / 5.0f * basis.tan_half_y * point.depth);
    });
}

TEST(SavedPointsRule, a_point_projects_into_its_pixel) {
    EXPECT_EQ(broken_rule(made_points()), "");
    const std::string rule = "point of pixel 13: position: must project into its pixel";
    for (const float inside : {-0.499f, 0.499f}) {
        EXPECT_EQ(rule_for_shift(inside, 0.0f), "");
        EXPECT_EQ(rule_for_shift(0.0f, inside), "");
    }
    for (const float outside : {-0.501f, 0.501f, 1.0f, -3.0f}) {
        EXPECT_EQ(rule_for_shift(outside, 0.0f), rule);
        EXPECT_EQ(rule_for_shift(0.0f, outside), rule);
    }
}

TEST(SavedPointsRule, a_depth_is_the_position_s_own) {
    const std::string rule = "point of pixel 13: depth: must be the position's own, within 2^-20";
    // The slack for the point's rounding at 7x5 and 1.2 radians is below 3 * 2^-22.
    for (const float factor : {1.0f + 0x1p-21f, 1.0f - 0x1p-21f})
        EXPECT_EQ(rule_for(9, [&](SavedPoint& point, const CameraBasis&) { point.depth *= factor; }), "");
    for (const float factor : {1.0f + 0x1p-19f, 1.0f - 0x1p-19f, 2.0f})
        EXPECT_EQ(rule_for(9, [&](SavedPoint& point, const CameraBasis&) { point.depth *= factor; }), rule);
    EXPECT_EQ(rule_for(9, [](SavedPoint& point, const CameraBasis&) { point.position = -point.position; }), rule);
}

// Far to the side of a wide view the terms of a point are many times its depth, and so is their rounding.
TEST(SavedPointsRule, rounding_is_granted_to_points_of_wide_views) {
    for (const float fov : {1.0f, 2.0f, 2.9f}) EXPECT_EQ(broken_rule(made_points(fov, 160, 90)), "") << fov;
}

TEST(PointFile, points_that_could_not_be_read_are_not_written) {
    const std::string path = temporary_path("unwritten");
    SavedPoints made = made_points();
    made.points[3].depth *= 2.0f;
    EXPECT_THROW(write_points(path, made, kMadeMaterials), InputError);
    EXPECT_THROW(write_points(path, made_points(), 1), InputError);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THROW(write_points(path + "/in/a/folder", made_points(), kMadeMaterials), InputError);
    EXPECT_THROW(write_points(testing::TempDir(), made_points(), kMadeMaterials), InputError);
}

TEST(PointFile, a_path_without_a_file_is_refused) {
    const auto what = [](const std::string& path) -> std::string {
        try {
            read_points(path, "made", 1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "read";
    };
    EXPECT_EQ(what("no/such.points"), "points \"no/such.points\": does not exist");
    EXPECT_EQ(what("/"), "points \"/\": is a folder, must be a file");
    EXPECT_EQ(what("/dev/zero"), "points \"/dev/zero\": cannot be read: must be a regular file");
}

} // namespace
} // namespace manylights::lab
