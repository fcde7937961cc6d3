#include "lab/scene/random.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab {
namespace {

/// A file with something of everything that the loader reads.
GltfFile rich_file() {
    GltfFile file = triangle_file();
    nlohmann::json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = file.add_positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["material"] = 0;
    const int indices = file.add_view<std::uint8_t>({2}), values = file.add_view<float>({0, 2, 0});
    file.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
    file.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"roughnessFactor", 0.5}}},
         {"emissiveFactor", {0.1, 0.1, 0.1}}}};
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 2.0}, {"range", 5.0}}};
    file.json["nodes"] = {
        {{"mesh", 0}, {"children", {1, 2}}, {"rotation", {0, 0, 0, 1}}},
        {{"camera", 0}, {"translation", {0, 0, 3}}},
        {{"mesh", 0}, {"scale", {2, 2, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    return file;
}

/// What every accepted scene promises, whatever the file was.
void expect_sound(const Scene& scene) {
    ASSERT_FALSE(scene.indices.empty());
    for (const std::uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());
    for (const Vertex& vertex : scene.vertices) {
        ASSERT_LT(vertex.material, scene.materials.size());
        ASSERT_NEAR(glm::length(vertex.normal), 1.0f, 1e-4f);
        ASSERT_TRUE(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
    }
    ASSERT_GE(scene.cameras.size(), 4u);
    for (const Light& light : scene.lights) ASSERT_TRUE(light.sphere.range >= 0.0f && light.sphere.range <= 1e18f);
}

/// Loads or refuses; anything else (a crash, another exception) fails the test.
bool survives(const std::string& bytes) {
    const std::string path = write_bytes("mutant.glb", bytes);
    if (!complaint(path).empty()) return false;
    expect_sound(load_scene(path));
    return true;
}

TEST(GltfFuzz, ChangedBytesAreReadOrRefused) {
    const std::string original = rich_file().glb();
    ASSERT_TRUE(survives(original));
    int accepted = 0;
    for (std::uint32_t i = 0; i < 500; ++i) {
        std::string mutant = original;
        const std::uint32_t changes = 1 + std::uint32_t(4.0f * random_unit(9, i, 0));
        for (std::uint32_t k = 0; k < changes; ++k) {
            const auto at = std::size_t(float(mutant.size()) * random_unit(9, i, 3 * k + 1));
            mutant[at] = char(hash_counter(9, i, 3 * k + 2) & 0xffu);
        }
        SCOPED_TRACE(i);
        accepted += survives(mutant) ? 1 : 0;
    }
    EXPECT_GT(accepted, 10);
    EXPECT_LT(accepted, 480);
}

TEST(GltfFuzz, ChangedNumbersAreReadOrRefused) {
    // The same with valid JSON: each number in it becomes each of these once.
    const GltfFile original = rich_file();
    const nlohmann::json replacements = {-1, 0, 2, 255, 4294967296ll, 1e30, "text", nlohmann::json::object()};
    const nlohmann::json flat = original.json.flatten();
    int accepted = 0, refused = 0;
    for (const auto& [pointer, value] : flat.items()) {
        if (!value.is_number()) continue;
        for (const nlohmann::json& replacement : replacements) {
            GltfFile mutant = original;
            mutant.json[nlohmann::json::json_pointer(pointer)] = replacement;
            SCOPED_TRACE(pointer + " = " + replacement.dump());
            (survives(mutant.glb()) ? accepted : refused) += 1;
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace manylights::lab
