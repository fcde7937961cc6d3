// Pictures and their files: exposure, tone mapping, PNG and EXR, and folders that cannot be written to.

#include "lab/renderer/image_file.h"
#include "lab/renderer/tone_map.h"
#include "lab/scene/error.h"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace manylights::lab {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone at the end.
struct Folder {
    fs::path path;
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "manylights-XXXXXX").string();
        path = mkdtemp(pattern.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::permissions(path, fs::perms::owner_all, ignored);
        fs::remove_all(path, ignored);
    }
    std::string file(const char* name) const { return (path / name).string(); }
    std::size_t entries() const { return std::size_t(std::distance(fs::directory_iterator(path), {})); }
};

Picture pattern(std::uint32_t width, std::uint32_t height) {
    Picture picture{width, height, {}};
    for (std::uint32_t i = 0; i < width * height * 3; ++i) picture.rgb.push_back(std::uint8_t(i * 37u + i / 7u));
    return picture;
}

std::vector<float> gray(std::size_t pixels, float value) { return std::vector<float>(pixels * 3, value); }

class ImageFile : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};

TEST_P(ImageFile, png_comes_back_as_it_was) {
    const auto [width, height] = GetParam();
    const Folder folder;
    const Picture picture = pattern(width, height);
    write_png(folder.file("a.png"), picture);
    int w = 0, h = 0, channels = 0;
    stbi_uc* pixels = stbi_load(folder.file("a.png").c_str(), &w, &h, &channels, 0);
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(std::uint32_t(w), width);
    EXPECT_EQ(std::uint32_t(h), height);
    EXPECT_EQ(channels, 3);
    EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), pixels));
    stbi_image_free(pixels);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST_P(ImageFile, exr_comes_back_as_it_was) {
    const auto [width, height] = GetParam();
    const Folder folder;
    std::vector<float> rgb;
    for (std::uint32_t i = 0; i < width * height * 3; ++i) rgb.push_back(float(i) * 1.7f + 1e-6f);
    write_exr(folder.file("a.exr"), rgb, width, height);
    const FloatImage image = read_exr(folder.file("a.exr"));
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.rgb, rgb);
    EXPECT_EQ(folder.entries(), 1u);
}

INSTANTIATE_TEST_SUITE_P(AwkwardSizes, ImageFile,
                         testing::Values(std::pair(1u, 1u), std::pair(47u, 33u), std::pair(48u, 48u)));

template <typename Write>
std::string complaint(const Write& write) {
    try {
        write();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(ImageFileErrors, name_the_path_and_why) {
    const Folder folder;
    const Picture picture = pattern(2, 2);
    const std::string missing = folder.file("no/such/a.png");
    const std::string text = complaint([&] { write_png(missing, picture); });
    EXPECT_NE(text.find(missing), std::string::npos) << text;
    EXPECT_NE(text.find("does not exist"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(complaint([&] { write_exr(missing, gray(4, 1.0f), 2, 2); }).find("does not exist"), std::string::npos);
    EXPECT_NE(complaint([&] { write_png(folder.path.string(), picture); }).find("is a folder"), std::string::npos);
    std::ofstream(folder.file("file")) << "x";
    EXPECT_NE(complaint([&] { write_png(folder.file("file/a.png"), picture); }).find("not a folder"),
              std::string::npos);
    EXPECT_NE(complaint([&] { (void)read_exr(folder.file("file")); }).find("cannot read"), std::string::npos);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(ImageFileErrors, leave_what_was_there) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const Folder folder;
    write_png(folder.file("a.png"), pattern(2, 2));
    fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_NE(complaint([&] { write_png(folder.file("a.png"), pattern(3, 3)); }).find("not writable"),
              std::string::npos);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(ImageFileErrors, leave_nothing_behind_when_the_disk_is_full) {
    if (!fs::exists("/dev/full")) GTEST_SKIP();
    const Folder folder;
    const std::string path = folder.file("a.png");
    // The name that the writer uses until the file is complete leads to a full device.
    fs::create_symlink("/dev/full", path + ".unfinished-" + std::to_string(getpid()));
    EXPECT_NE(complaint([&] { write_png(path, pattern(48, 48)); }).find("No space left"), std::string::npos);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(AutoExposure, puts_an_even_picture_at_middle_grey) {
    const std::vector<std::uint8_t> shaded(100, 1);
    for (const float value : {1e-6f, 1.0f, 1e6f})
        EXPECT_NEAR(auto_exposure(gray(100, value), shaded) * value, 0.18f, 1e-4f);
}

TEST(AutoExposure, does_not_burn_out_the_lit_part_of_a_dark_picture) {
    std::vector<float> radiance = gray(100, 1e-3f);
    for (std::size_t i = 0; i < 30; ++i) radiance[i] = 5.0f;
    const float exposure = auto_exposure(radiance, std::vector<std::uint8_t>(100, 1));
    EXPECT_FLOAT_EQ(exposure * 5.0f, 2.0f);
}

TEST(AutoExposure, does_not_count_the_sky_and_the_unlit) {
    std::vector<std::uint8_t> shaded(100, 1);
    std::vector<float> radiance = gray(100, 2.0f);
    const float expected = auto_exposure(radiance, shaded);
    for (std::size_t i = 0; i < 50; ++i) shaded[i] = 0;
    for (std::size_t i = 0; i < 150; ++i) radiance[i] = 1e6f;
    EXPECT_FLOAT_EQ(auto_exposure(radiance, shaded), expected);
    for (std::size_t i = 0; i < 150; ++i) radiance[i] = 0.0f;
    shaded.assign(100, 1);
    EXPECT_FLOAT_EQ(auto_exposure(radiance, shaded), expected);
    EXPECT_EQ(auto_exposure(gray(100, 0.0f), shaded), 1.0f);
    EXPECT_EQ(auto_exposure(radiance, std::vector<std::uint8_t>(100, 0)), 1.0f);
}

TEST(ToneMap, is_monotone_from_black_to_white) {
    std::vector<float> radiance;
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c) radiance.push_back(i == 255 ? 1e30f : float(i) * 0.05f);
    const Picture picture = tone_map(radiance, std::vector<std::uint8_t>(256, 1), 256, 1, 1.0f);
    EXPECT_EQ(picture.rgb[0], 0);
    EXPECT_EQ(picture.rgb[3 * 255], 255);
    for (std::size_t i = 1; i < 256; ++i) EXPECT_GE(picture.rgb[3 * i], picture.rgb[3 * i - 3]) << i;
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(picture.rgb[3 * i], picture.rgb[3 * i + 2]) << i;
}

TEST(ToneMap, shows_sky_as_a_gradient_and_mistakes_in_magenta) {
    std::vector<float> radiance = gray(6, 0.5f);
    radiance[3] = std::numeric_limits<float>::quiet_NaN();
    const Picture picture = tone_map(radiance, std::vector<std::uint8_t>{1, 1, 0, 0, 0, 0}, 2, 3, 1.0f);
    EXPECT_EQ(std::vector<std::uint8_t>(picture.rgb.begin() + 3, picture.rgb.begin() + 6),
              (std::vector<std::uint8_t>{255, 0, 255}));
    EXPECT_LT(picture.rgb[6], picture.rgb[12]);
    EXPECT_EQ(picture.rgb[12], picture.rgb[15]);
}

} // namespace
} // namespace manylights::lab
