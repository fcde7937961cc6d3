#include "lab/scene/error.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace manylights::lab {
namespace {

void expect_complaint(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" does not say \"" << part << "\"";
}

TEST(BadGltf, FilesThatAreNone) {
    expect_complaint(complaint(temporary_path("absent.glb")), "does not exist");
    expect_complaint(complaint(write_bytes("empty.glb", "")), "is empty");
    expect_complaint(complaint(write_bytes("text.gltf", "hello")), "is not a glTF file");
    expect_complaint(complaint(write_bytes("array.gltf", "[1, 2]")), "is not a glTF file");
    expect_complaint(complaint(write_bytes("object.gltf", "{}")), "is not a glTF file");
    expect_complaint(complaint(write_bytes("picture.glb", "\x89PNG\r\n\x1a\n0123456789abcdef")), "is not a glTF file");
    expect_complaint(complaint(write_bytes("old.gltf", R"({"asset":{"version":"1.0"}})")), "must be 2.x");
    expect_complaint(complaint(write_bytes("deep.gltf", std::string(100'000, '['))), "nested");
    const std::string deep_extras =
        R"({"asset":{"version":"2.0","extras":)" + std::string(100'000, '[') + "1" + std::string(100'000, ']') + "}}";
    expect_complaint(complaint(write_bytes("deep2.gltf", deep_extras)), "nested");
}

TEST(BadGltf, FoldersAreNoFiles) {
    const std::string path = temporary_path("folder.glb");
    ASSERT_EQ(std::system(("mkdir -p '" + path + "'").c_str()), 0);
    expect_complaint(complaint(path), "is not a file");
}

TEST(BadGltf, EveryTruncationIsRefused) {
    const std::string bytes = triangle_file().glb();
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_NE(complaint(write_bytes("truncated.glb", bytes.substr(0, size))), "") << size << " bytes";
}

struct Case {
    const char* name;
    std::function<void(GltfFile&)> damage;
    const char* part; ///< of the message
};

class BadGltfContent : public testing::TestWithParam<Case> {};

TEST_P(BadGltfContent, IsRefusedWithTheRule) {
    GltfFile file = triangle_file();
    ASSERT_EQ(complaint(file), "") << "the undamaged file must load";
    GetParam().damage(file);
    expect_complaint(complaint(file), GetParam().part);
}

const float kNan = std::numeric_limits<float>::quiet_NaN();

nlohmann::json& primitive(GltfFile& file) { return file.json["meshes"][0]["primitives"][0]; }

const Case kCases[] = {
    {"no_meshes",
     [](GltfFile& f) {
         f.json.erase("meshes");
         f.json["nodes"][0].erase("mesh");
     },
     "no geometry"},
    {"no_nodes_in_scene", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = nlohmann::json::array(); }, "no geometry"},
    {"only_points", [](GltfFile& f) { primitive(f)["mode"] = 0; }, "no geometry"},
    {"only_flat_triangles",
     [](GltfFile& f) {
         f.json["nodes"][0]["scale"] = {1, 0, 1};
     },
     "no geometry"},
    {"two_indices", [](GltfFile& f) { f.json["accessors"][1]["count"] = 2; }, "no geometry"},
    {"scene_out_of_range", [](GltfFile& f) { f.json["scene"] = 5; }, "scene 5"},
    {"node_out_of_range", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {7}; }, "node 7"},
    {"negative_node", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {-2}; }, "node -2"},
    {"mesh_out_of_range", [](GltfFile& f) { f.json["nodes"][0]["mesh"] = 3; }, "mesh 3"},
    {"camera_out_of_range", [](GltfFile& f) { f.json["nodes"][0]["camera"] = 1; }, "camera 1"},
    {"material_out_of_range", [](GltfFile& f) { primitive(f)["material"] = 2; }, "material 2"},
    {"cycle", [](GltfFile& f) { f.json["nodes"][0]["children"] = {0}; }, "must form a tree"},
    {"longer_cycle",
     [](GltfFile& f) {
         f.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
     },
     "must form a tree"},
    {"two_parents",
     [](GltfFile& f) {
         f.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
         f.json["scenes"][0]["nodes"] = {0, 1};
     },
     "must form a tree"},
    {"vertex_index_too_large",
     [](GltfFile& f) {
         primitive(f)["indices"] = f.add_accessor(f.add_view<std::uint16_t>({0, 1, 3}), 5123, 3, "SCALAR");
     },
     "vertex index 3"},
    {"accessor_out_of_range", [](GltfFile& f) { primitive(f)["attributes"]["POSITION"] = 9; }, "accessor 9"},
    {"index_accessor_out_of_range", [](GltfFile& f) { primitive(f)["indices"] = 9; }, "accessor"},
    {"accessor_too_long", [](GltfFile& f) { f.json["accessors"][0]["count"] = 4; }, "beyond its buffer view"},
    {"accessor_absurdly_long", [](GltfFile& f) { f.json["accessors"][0]["count"] = 4611686018427387904ll; },
     "beyond its buffer view"},
    {"accessor_offset_too_large", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 1000; },
     "beyond its buffer view"},
    {"accessor_offset_wraps", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 18446744073709551608ull; },
     "accessor 0"},
    {"view_beyond_buffer", [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 5000; }, "beyond its buffer"},
    {"view_offset_beyond_buffer", [](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 5000; },
     "beyond its buffer"},
    {"view_of_no_buffer", [](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 4; }, "a buffer that does not exist"},
    {"view_out_of_range", [](GltfFile& f) { f.json["accessors"][0]["bufferView"] = 44; }, "buffer view 44"},
    {"stride_too_small", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 4; }, "stride"},
    {"empty_accessor", [](GltfFile& f) { f.json["accessors"][0]["count"] = 0; }, "accessor 0"},
    {"positions_of_wrong_type", [](GltfFile& f) { f.json["accessors"][0]["type"] = "VEC2"; }, "VEC3"},
    {"positions_of_wrong_components", [](GltfFile& f) { f.json["accessors"][0]["componentType"] = 5125; },
     "component type"},
    {"float_indices", [](GltfFile& f) { f.json["accessors"][1]["componentType"] = 5126; }, "component type"},
    {"huge_accessor_without_data",
     [](GltfFile& f) {
         f.json["accessors"][0].erase("bufferView");
         f.json["accessors"][0]["count"] = 2000000000;
     },
     "no buffer view"},
    {"sparse_index_too_large",
     [](GltfFile& f) {
         const int indices = f.add_view<std::uint8_t>({9}), values = f.add_view<float>({1, 1, 1});
         f.json["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", values}}}};
     },
     "sparse index"},
    {"normals_of_other_count",
     [](GltfFile& f) {
         primitive(f)["attributes"]["NORMAL"] = f.add_positions({0, 0, 1});
     },
     "as many normals as positions"},
    {"nan_position",
     [](GltfFile& f) {
         primitive(f)["attributes"]["POSITION"] = f.add_positions({0, 0, 0, 1, kNan, 0, 0, 1, 0});
     },
     "must be finite"},
    {"far_position",
     [](GltfFile& f) {
         primitive(f)["attributes"]["POSITION"] = f.add_positions({0, 0, 0, 1e30f, 0, 0, 0, 1, 0});
     },
     "within 1e9"},
    {"far_by_transform",
     [](GltfFile& f) {
         f.json["nodes"][0]["scale"] = {1e12, 1, 1};
     },
     "within 1e9"},
    {"absurd_transform",
     [](GltfFile& f) {
         f.json["nodes"][0]["scale"] = {1e30, 1, 1};
     },
     "transform"},
    {"negative_color",
     [](GltfFile& f) {
         f.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {-1, 0, 0, 1}}}}}};
     },
     "material 0"},
    {"bad_field_of_view",
     [](GltfFile& f) {
         f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 4.0}, {"znear", 0.1}}}}};
         f.json["nodes"][0]["camera"] = 0;
     },
     "yfov"},
    {"unknown_light",
     [](GltfFile& f) {
         f.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 2}}}};
     },
     "light 2"},
    {"negative_light",
     [](GltfFile& f) {
         f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", -3.0}}};
         f.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
     },
     "intensity"},
    {"compressed", [](GltfFile& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "KHR_draco_mesh_compression"},
    {"buffer_missing_from_disk",
     [](GltfFile& f) {
         f.json["buffers"] = {{{"byteLength", 44}, {"uri", "no_such_file.bin"}}};
     },
     "no_such_file.bin"},
    {"buffer_longer_than_chunk",
     [](GltfFile& f) {
         f.json["buffers"] = {{{"byteLength", 4000}}};
     },
     "glTF"},
    {"buffer_data_not_base64",
     [](GltfFile& f) {
         f.json["buffers"] = {{{"byteLength", 44}, {"uri", "data:application/octet-stream;base64,!!!"}}};
     },
     "glTF"},
};

INSTANTIATE_TEST_SUITE_P(All, BadGltfContent, testing::ValuesIn(kCases),
                         [](const testing::TestParamInfo<Case>& test) { return test.param.name; });

} // namespace
} // namespace manylights::lab
