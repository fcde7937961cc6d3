#include "tests/parity/techniques_fixture.h"

#include "lab/scene/error.h"
#include "reference/oracle/random.h"
#include "tests/parity/validated_device.h"

#include <cstdio>
#include <mutex>

namespace manylights::lab {

namespace {

std::once_flag announced;

PointPosition made_position(const CameraBasis& basis, std::uint32_t width, std::uint32_t height, std::size_t pixel,
                            oracle::Random& random) {
    const float x = (2.0f * (static_cast<float>(pixel % width) + 0.5f) / static_cast<float>(width) - 1.0f);
    const float y = (1.0f - 2.0f * (static_cast<float>(pixel / width) + 0.5f) / static_cast<float>(height));
    const float depth = static_cast<float>(random.octaves(-2, 9));
    if (random.chance(0.125)) return {glm::vec3(0.0f), 0.0f};
    const glm::vec3 ray = basis.forward + basis.right * (x * basis.tan_half_x) + basis.up * (y * basis.tan_half_y);
    return {ray * depth, depth};
}

PointNormal made_normal(oracle::Random& random) {
    const oracle::Double3 direction = random.direction();
    return {glm::vec3(direction.x, direction.y, direction.z), random.below(2)};
}

Light made_light(const View& view, oracle::Random& random) {
    const PointPosition& point = view.positions[random.below(static_cast<std::uint32_t>(view.positions.size()))];
    const double range = 0.02 * (1.0 + double(point.depth)) * random.octaves(0, 3);
    const oracle::Double3 offset = random.direction() * (range * random.unit() * 1.1);
    const glm::vec3 center = view.camera.position + point.position + glm::vec3(offset.x, offset.y, offset.z);
    Light light;
    light.sphere = {{center.x, center.y, center.z}, static_cast<float>(range)};
    for (float& channel : light.color) channel = static_cast<float>(random.between(0.1, 1.0) * range * range);
    return light;
}

Scene made_scene() {
    Scene scene;
    scene.name = "made";
    scene.view_extent = 500.0f;
    return scene;
}

Camera made_camera() {
    Camera camera;
    camera.position = {12.3f, 4.5f, -67.8f};
    camera.forward = {0.6f, 0.0f, -0.8f};
    return camera;
}

} // namespace

void TechniquesTest::SetUp() {
    try {
        device_ = &validated_device();
    } catch (const DeviceError& error) {
        GTEST_SKIP() << error.what();
    }
    std::call_once(announced, [this] {
        std::printf("device %s, %s; core and synchronization validation by %s\n", device_->info().name.c_str(),
                    device_->info().version.c_str(), device_->validation_layer().c_str());
    });
    ASSERT_TRUE(device_->validation_active());
}

void TechniquesTest::TearDown() {
    if (device_ == nullptr) return;
    EXPECT_EQ(device_->validation_messages(), 0u);
}

View made_view(gpu::Device& device, std::uint32_t width, std::uint32_t height, std::uint32_t light_count) {
    const std::vector<MaterialRecord> materials{{glm::vec3(0.8f, 0.5f, 0.3f), 0.6f, glm::vec3(0.0f), 0.0f},
                                                {glm::vec3(0.9f), 0.2f, glm::vec3(0.1f, 0.0f, 0.2f), 1.0f}};
    View view{made_scene(), made_camera(), width, height, {}, {}, {}, PointBuffer(device, width, height, materials)};
    oracle::Random random(std::uint64_t{width} * 65537 + height);
    const CameraBasis basis = camera_basis(view.camera, width, height);
    for (std::size_t pixel = 0; pixel < std::size_t{width} * height; ++pixel) {
        view.positions.push_back(made_position(basis, width, height, pixel, random));
        view.normals.push_back(made_normal(random));
    }
    for (std::uint32_t i = 0; i < light_count; ++i) view.lights.push_back(made_light(view, random));
    view.points.positions().upload(view.positions);
    view.points.normals().upload(view.normals);
    return view;
}

void add_lights_that_end_at_points(View& view) {
    const glm::vec3 forward = camera_basis(view.camera, view.width, view.height).forward;
    oracle::Random random(4);
    for (const PointPosition& point : view.positions) {
        if (point.depth == 0.0f || !random.chance(0.25)) continue;
        const float range = static_cast<float>(0.5 * point.depth * random.unit());
        const float side = random.chance(0.5) ? 1.0f : -1.0f;
        const glm::vec3 center = view.camera.position + point.position + forward * (side * range * 0.9999999f);
        view.lights.push_back({{{center.x, center.y, center.z}, range}, {1, 1, 1}});
    }
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.label; }

std::vector<Variant> structure_variants() {
    return {{"clustered", "clustered", {}},
            {"tiled_light_trees", "tiled_light_trees", {}},
            {"hybrid_light_trees", "hybrid_light_trees", {}},
            {"depth_windows", "depth_windows", {}},
            {"depth_windows_depth", "depth_windows", {{"depth", "on"}}},
            {"depth_windows_wave", "depth_windows_wave", {}},
            {"depth_windows_wave_32", "depth_windows_wave", {{"wave", "32"}}},
            {"depth_windows_wave_64", "depth_windows_wave", {{"wave", "64"}}},
            {"clustered_paper", "clustered", {{"producer", "paper"}}},
            {"clustered_tight", "clustered", {{"cell_test", "tight"}, {"tile_size", "16"}, {"slice_count", "128"}}},
            {"clustered_wave", "clustered", {{"loop", "wave"}}},
            {"clustered_tight_wave",
             "clustered",
             {{"cell_test", "tight"}, {"loop", "wave"}, {"tile_size", "8"}, {"slice_count", "64"}}},
            {"tiled_light_trees_paper", "tiled_light_trees", {{"producer", "paper"}}},
            {"hybrid_light_trees_paper", "hybrid_light_trees", {{"producer", "paper"}}},
            {"tiled_light_trees_device", "tiled_light_trees", {{"build", "device"}, {"lds", "on"}}},
            {"hybrid_light_trees_device",
             "hybrid_light_trees",
             {{"build", "device"}, {"paths", "three"}, {"lights", "duplicated"}}},
            {"tiled_light_trees_slices",
             "tiled_light_trees",
             {{"producer", "paper"}, {"entry", "slice"}, {"tree", "top_down"}, {"sort", "cell"}}}};
}

std::vector<Variant> all_variants() {
    std::vector<Variant> variants = structure_variants();
    variants.push_back({"exact", "exact", {}});
    variants.insert(variants.end(),
                    {{"z_bins", "z_bins", {}},
                     {"z_bins_8", "z_bins", {{"tile_size", "8"}, {"bins", "1024"}, {"summary", "on"}}},
                     {"z_bins_16", "z_bins", {{"tile_size", "16"}, {"bins", "4096"}, {"spacing", "log"}}},
                     {"z_bins_64", "z_bins", {{"tile_size", "64"}, {"bins", "2048"}, {"sort_key", "near"}}},
                     {"z_bins_wave", "z_bins", {{"loop", "wave"}, {"summary", "on"}, {"spacing", "log"}}}});
    variants.insert(
        variants.end(),
        {{"light_linked_list", "light_linked_list", {}},
         {"light_linked_list_full", "light_linked_list", {{"resolution", "full"}, {"link_bytes", "16"}}},
         {"light_linked_list_quarter", "light_linked_list", {{"resolution", "quarter"}, {"link_bytes", "12"}}},
         {"light_linked_list_air", "light_linked_list", {{"depth_test", "off"}, {"first_links", "0"}}},
         {"light_volumes", "light_volumes", {}},
         {"light_volumes_front", "light_volumes", {{"volume", "front"}, {"mesh_level", "0"}}},
         {"light_volumes_all", "light_volumes", {{"volume", "all"}, {"mesh_level", "0"}, {"order", "near"}}},
         {"light_volumes_rectangle", "light_volumes", {{"volume", "rectangle"}}}});
    variants.push_back({"tiled", "tiled", {}});
    variants.push_back({"tiled_max_planes", "tiled", {{"depth", "max"}, {"test", "planes"}, {"tile_size", "13"}}});
    variants.push_back({"tiled_none_rectangle", "tiled", {{"depth", "none"}, {"test", "rectangle"}}});
    variants.push_back({"tiled_counted", "tiled", {{"tiles", "32x32"}}});
    variants.push_back({"culling_2_5d", "culling_2_5d", {}});
    variants.push_back({"culling_2_5d_b", "culling_2_5d", {{"variant", "b"}, {"cells", "64"}, {"tile_size", "13"}}});
    variants.push_back({"culling_2_5d_b_16", "culling_2_5d", {{"variant", "b"}, {"cells", "16"}}});
    variants.push_back({"culling_2_5d_c", "culling_2_5d", {{"variant", "c"}, {"cells", "8"}, {"interval", "sphere"}}});
    variants.push_back({"clustered_samples", "clustered_samples", {}});
    variants.push_back({"clustered_samples_pages",
                        "clustered_samples",
                        {{"unique", "page_table"}, {"bounds", "explicit"}, {"tile_size", "16"}, {"fan_out", "8"}}});
    variants.push_back({"clustered_samples_bitmap", "clustered_samples", {{"unique", "bitmap"}, {"fan_out", "16"}}});
    variants.push_back(
        {"clustered_samples_hierarchy", "clustered_samples", {{"query", "hierarchy"}, {"fan_out", "8"}}});
    // Few slices: lists of all froxels hold the large lights of made views a thousand times over.
    variants.push_back({"hybrid_lighting", "hybrid_lighting", {{"slices", "16"}}});
    variants.push_back({"hybrid_lighting_linked",
                        "hybrid_lighting",
                        {{"lists", "linked"}, {"tiles", "32x32"}, {"division", "view_uniform"}, {"slices", "8"}}});
    variants.push_back({"hybrid_lighting_occupied",
                        "hybrid_lighting",
                        {{"cells", "occupied"}, {"tiles", "7x11"}, {"division", "screen_uniform"}, {"slices", "256"}}});
    variants.push_back({"hybrid_lighting_linked_occupied",
                        "hybrid_lighting",
                        {{"lists", "linked"}, {"cells", "occupied"}, {"slices", "40"}}});
    variants.push_back({"hybrid_lighting_raster", "hybrid_lighting", {{"billboards", "raster"}, {"slices", "16"}}});
    variants.push_back({"hybrid_lighting_raster_linked",
                        "hybrid_lighting",
                        {{"billboards", "raster"}, {"lists", "linked"}, {"tiles", "60x34"}, {"cells", "occupied"}}});
    variants.push_back({"octree", "octree", {}});
    variants.push_back({"octree_dense",
                        "octree",
                        {{"nodes", "dense"},
                         {"unique", "sort"},
                         {"corners", "computed"},
                         {"assign", "tiles"},
                         {"tiles", "16x9"},
                         {"division", "view_uniform"}}});
    variants.push_back({"octree_leaves",
                        "octree",
                        {{"inner", "off"},
                         {"assign", "billboards"},
                         {"unique", "compact_sort"},
                         {"tiles", "12x12"},
                         {"division", "screen_uniform"},
                         {"slices", "64"}}});
    return variants;
}

std::vector<PixelRecord> records_of(gpu::Device& device, const Variant& variant, const Frame& frame) {
    const std::unique_ptr<Technique> technique = make_technique(device, variant.technique, variant.options);
    technique->prepare(frame);
    return technique->record(frame);
}

} // namespace manylights::lab
