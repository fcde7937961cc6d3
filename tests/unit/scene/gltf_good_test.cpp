#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::lab {
namespace {

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(actual - expected), tolerance) << actual.x << " " << actual.y << " " << actual.z << ", not "
                                                         << expected.x << " " << expected.y << " " << expected.z;
}

glm::vec3 corner(const Scene& scene, std::size_t i) { return scene.vertices[scene.indices.at(i)].position; }

TEST(Gltf, ReadsATriangleWithFlatNormals) {
    const Scene scene = load(triangle_file());
    ASSERT_EQ(scene.indices.size(), 3u);
    expect_near(corner(scene, 1), {1, 0, 0});
    expect_near(corner(scene, 2), {0, 1, 0});
    for (const Vertex& vertex : scene.vertices) expect_near(vertex.normal, {0, 0, 1});
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1, 1, 0));
    EXPECT_EQ(scene.cameras.size(), 4u);
    EXPECT_EQ(scene.path.size(), 16u);
    EXPECT_NEAR(scene.view_extent, std::sqrt(2.0f), 1e-6f);
}

TEST(Gltf, ComposesTransformsOfTheHierarchy) {
    GltfFile file = triangle_file();
    // Parent: a matrix that moves by (10, 0, 0). Child: scaled by 2 in x, turned a quarter about z, moved by (0, 5, 0).
    const double half = std::sqrt(0.5);
    file.json["nodes"] = {
        {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}},
        {{"mesh", 0}, {"translation", {0, 5, 0}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 1, 1}}}};
    const Scene scene = load(file);
    expect_near(corner(scene, 0), {10, 5, 0});
    expect_near(corner(scene, 1), {10, 7, 0});
    expect_near(corner(scene, 2), {9, 5, 0});
    expect_near(scene.vertices[0].normal, {0, 0, 1});
}

TEST(Gltf, KeepsNormalsOutsideWhenMirrored) {
    GltfFile file = triangle_file();
    const int normals = file.add_positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    file.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Scene scene = load(file);
    const glm::vec3 faces = glm::cross(corner(scene, 1) - corner(scene, 0), corner(scene, 2) - corner(scene, 0));
    expect_near(glm::normalize(faces), {0, 0, 1});
    expect_near(scene.vertices[0].normal, {0, 0, 1});
}

TEST(Gltf, TransformsNormalsByTheInverseTranspose) {
    GltfFile file = triangle_file();
    const float s = std::sqrt(0.5f);
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = file.add_positions({s, 0, s, s, 0, s, s, 0, s});
    file.json["nodes"][0]["scale"] = {2, 1, 1};
    expect_near(load(file).vertices[0].normal, glm::normalize(glm::vec3(0.5f, 0, 1)));
}

TEST(Gltf, ReplacesMissingDirectionsOfNormals) {
    GltfFile file = triangle_file();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = file.add_positions({0, 0, 0, nan, 0, 0, 0, 0, 3});
    for (const Vertex& vertex : load(file).vertices) expect_near(vertex.normal, {0, 0, 1});
}

TEST(Gltf, ReadsIndicesOfEveryWidthAndNone) {
    for (const int type : {5121, 5123, 5125, 0}) {
        GltfFile file = triangle_file();
        nlohmann::json& primitive = file.json["meshes"][0]["primitives"][0];
        if (type == 5121)
            primitive["indices"] = file.add_accessor(file.add_view<std::uint8_t>({0, 2, 1}), type, 3, "SCALAR");
        if (type == 5123)
            primitive["indices"] = file.add_accessor(file.add_view<std::uint16_t>({0, 2, 1}), type, 3, "SCALAR");
        if (type == 5125)
            primitive["indices"] = file.add_accessor(file.add_view<std::uint32_t>({0, 2, 1}), type, 3, "SCALAR");
        if (type == 0) primitive.erase("indices");
        const Scene scene = load(file);
        ASSERT_EQ(scene.indices.size(), 3u);
        expect_near(corner(scene, 1), type == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
    }
}

TEST(Gltf, ReadsStridedPositions) {
    GltfFile file = triangle_file();
    const int view = file.add_view<float>({0, 0, 0, 9, 9, 2, 0, 0, 9, 9, 0, 3, 0, 9, 9});
    file.json["bufferViews"][std::size_t(view)]["byteStride"] = 20;
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.add_accessor(view, 5126, 3, "VEC3");
    const Scene scene = load(file);
    expect_near(corner(scene, 1), {2, 0, 0});
    expect_near(corner(scene, 2), {0, 3, 0});
}

TEST(Gltf, ReadsSparsePositionsWithAndWithoutABase) {
    for (const bool with_base : {true, false}) {
        GltfFile file = triangle_file();
        const int indices = file.add_view<std::uint8_t>({1, 2}), values = file.add_view<float>({4, 0, 0, 0, 6, 0});
        nlohmann::json& accessor = file.json["accessors"][0];
        accessor["sparse"] = {{"count", 2},
                              {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                              {"values", {{"bufferView", values}}}};
        if (!with_base) accessor.erase("bufferView");
        const Scene scene = load(file);
        expect_near(corner(scene, 0), {0, 0, 0});
        expect_near(corner(scene, 1), {4, 0, 0});
        expect_near(corner(scene, 2), {0, 6, 0});
    }
}

TEST(Gltf, ReadsQuantizedPositions) {
    GltfFile file = triangle_file();
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int view = file.add_view<std::int16_t>({0, 0, 0, 32767, 0, 0, 0, -32768, 0});
    const int accessor = file.add_accessor(view, 5122, 3, "VEC3");
    file.json["accessors"][std::size_t(accessor)]["normalized"] = true;
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    const Scene scene = load(file);
    expect_near(corner(scene, 1), {1, 0, 0});
    expect_near(corner(scene, 2), {0, -1, 0});
}

TEST(Gltf, TurnsStripsAndFansIntoTrianglesThatFaceOneWay) {
    for (const int mode : {5, 6}) {
        GltfFile file = triangle_file();
        nlohmann::json& primitive = file.json["meshes"][0]["primitives"][0];
        primitive.erase("indices");
        primitive["mode"] = mode;
        primitive["attributes"]["POSITION"] = mode == 5 ? file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})
                                                        : file.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        const Scene scene = load(file);
        ASSERT_EQ(scene.indices.size(), 6u);
        for (const Vertex& vertex : scene.vertices) expect_near(vertex.normal, {0, 0, 1});
    }
}

TEST(Gltf, LeavesOutTrianglesWithoutArea) {
    GltfFile file = triangle_file();
    file.json["meshes"][0]["primitives"][0]["indices"] =
        file.add_accessor(file.add_view<std::uint16_t>({0, 1, 2, 1, 1, 2}), 5123, 6, "SCALAR");
    EXPECT_EQ(load(file).indices.size(), 3u);
}

TEST(Gltf, ReadsMaterialFactors) {
    GltfFile file = triangle_file();
    file.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.25, 0.5, 0.75, 1.0}}, {"roughnessFactor", 0.125}, {"metallicFactor", 0.5}}},
         {"emissiveFactor", {0.5, 0.25, 0.0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = load(file);
    const Material& material = scene.materials.at(scene.vertices[0].material);
    expect_near(material.base_color, {0.25f, 0.5f, 0.75f});
    expect_near(material.emissive, {2, 1, 0});
    EXPECT_FLOAT_EQ(material.roughness, 0.125f);
    EXPECT_FLOAT_EQ(material.metallic, 0.5f);
}

TEST(Gltf, ReadsPerspectiveCameras) {
    GltfFile file = triangle_file();
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.02}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}}};
    const double half = std::sqrt(0.5);
    file.json["nodes"].push_back(
        {{"camera", 0}, {"name", "door"}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}});
    file.json["nodes"].push_back({{"camera", 0}, {"name", "door"}});
    file.json["nodes"].push_back({{"camera", 1}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = load(file);
    ASSERT_EQ(scene.cameras.size(), 4u); // two of the file, two generated
    EXPECT_EQ(scene.cameras[0].name, "door");
    EXPECT_EQ(scene.cameras[1].name, "door2");
    expect_near(scene.cameras[0].position, {1, 2, 3});
    expect_near(scene.cameras[0].forward, {-1, 0, 0}); // -z turned a quarter about y
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near_plane, 0.02f);
}

TEST(Gltf, ReadsPointLightsAndIgnoresOtherKinds) {
    GltfFile file = triangle_file();
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"color", {1.0, 0.5, 0.25}}, {"intensity", 8.0}, {"range", 3.0}},
        {{"type", "point"}, {"color", {0.0, 1.0, 0.0}}, {"intensity", 4.0}},
        {{"type", "directional"}},
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    for (int light = 0; light < 4; ++light)
        file.json["nodes"].push_back(
            {{"translation", {0, light, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
    const Scene scene = load(file);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_FLOAT_EQ(scene.lights[0].color[1], 4.0f);
    EXPECT_FLOAT_EQ(scene.lights[0].sphere.range, 3.0f);
    EXPECT_FLOAT_EQ(scene.lights[1].sphere.center[1], 1.0f);
    // Without a range: where intensity / range^2 = 1/256.
    EXPECT_FLOAT_EQ(scene.lights[1].sphere.range, 32.0f);
}

TEST(Gltf, ReadsTextFilesWithEmbeddedAndExternalBuffers) {
    GltfFile file = triangle_file();
    const std::string name = temporary_path("external.bin");
    write_bytes("external.bin", std::string(file.binary.begin(), file.binary.end()));
    file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", name.substr(name.rfind('/') + 1)}}};
    EXPECT_EQ(load_scene(write_bytes("external.gltf", file.json.dump())).indices.size(), 3u);
    // The same 42 bytes in base64.
    file.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,"
                                     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA";
    EXPECT_EQ(load_scene(write_bytes("embedded.gltf", file.json.dump())).indices.size(), 3u);
}

TEST(Gltf, ReadsFilesWithoutScenes) {
    GltfFile file = triangle_file();
    file.json.erase("scene");
    file.json.erase("scenes");
    file.json["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 1}}}, {{"children", {0}}, {"translation", {0, 0, 2}}}};
    expect_near(corner(load(file), 0), {0, 0, 3});
}

} // namespace
} // namespace manylights::lab
