#include "tests/unit/points/made_points.h"

#include "lab/renderer/point_file.h"
#include "lab/scene/error.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace manylights::lab {

namespace {

Camera made_camera(float vertical_fov) {
    Camera camera;
    camera.name = "tilted";
    camera.position = {3.0f, -2.0f, 7.0f};
    camera.forward = glm::vec3(2.0f, 3.0f, 6.0f) / 7.0f;
    camera.vertical_fov = vertical_fov;
    camera.near_plane = 0.25f;
    return camera;
}

SavedPoint made_point(const CameraBasis& basis, const SavedPoints& image, std::uint32_t pixel) {
    const float depth = 0.25f + 0.37f * static_cast<float>(pixel) * static_cast<float>(pixel);
    const float x = (2.0f * static_cast<float>(pixel % image.width) + 1.0f) / static_cast<float>(image.width) - 1.0f;
    const float y = 1.0f - (2.0f * static_cast<float>(pixel / image.width) + 1.0f) / static_cast<float>(image.height);
    const glm::vec3 ray = basis.right * (x * basis.tan_half_x) + basis.up * (y * basis.tan_half_y) + basis.forward;
    return {pixel, ray * depth, depth, {0.0f, 0.6f, 0.8f}, pixel % std::uint32_t{kMadeMaterials}};
}

} // namespace

SavedPoints made_points(float vertical_fov, std::uint32_t width, std::uint32_t height) {
    SavedPoints made{"made", made_camera(vertical_fov), width, height, {}};
    const CameraBasis basis = camera_basis(made.camera, made.width, made.height);
    for (std::uint32_t pixel = 0; pixel < made.width * made.height; ++pixel)
        if (pixel % 3 != 2) made.points.push_back(made_point(basis, made, pixel));
    return made;
}

std::string temporary_path(const std::string& name) {
    return testing::TempDir() + "manylights-points-" + std::to_string(getpid()) + "-" + name;
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

std::string made_bytes() {
    const std::string path = temporary_path("made");
    write_points(path, made_points(), kMadeMaterials);
    const std::string bytes = bytes_of(path);
    std::filesystem::remove(path);
    return bytes;
}

void write_text(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

std::string sealed(std::string bytes) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (std::size_t i = 0; i + 8 < bytes.size(); ++i)
        hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001B3u;
    for (std::size_t i = 0; i < 8; ++i) bytes[bytes.size() - 8 + i] = static_cast<char>(hash >> (8 * i));
    return bytes;
}

std::string refusal(const std::string& bytes) {
    const std::string path = temporary_path("bad");
    write_text(path, bytes);
    std::string what;
    try {
        read_points(path, "made", kMadeMaterials);
    } catch (const InputError& error) {
        what = error.what();
    }
    std::filesystem::remove(path);
    const std::string prefix = "points \"" + path + "\": ";
    if (what.empty()) return "";
    EXPECT_TRUE(what.starts_with(prefix)) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(prefix.size());
}

} // namespace manylights::lab
