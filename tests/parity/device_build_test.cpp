// Structures of the library's format built on the device: valid, exact, the same in every run, and what their options
// do.

#include "lab/scene/error.h"
#include "lab/techniques/device/depth_slices.h"
#include "lab/techniques/device_build/device_build.h"
#include "lab/techniques/device_build/grid_references.h"
#include "lab/techniques/host_structure.h"
#include "lab/techniques/light_records.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::lab {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr const char* kTechniques[] = {"clustered", "tiled_light_trees", "hybrid_light_trees"};
constexpr StructureKind kKinds[] = {StructureKind::lists, StructureKind::trees, StructureKind::hybrid};

OptionValues on_device(OptionValues options = {}) {
    options.emplace_back("build", "device");
    return options;
}

StructureOptions structure_options(StructureKind kind) {
    StructureOptions options;
    options.kind = kind;
    options.on_device = true;
    return options;
}

/// All that decides which passes run, and on what.
std::vector<Variant> variants() {
    return {{"lists", "clustered", on_device()},
            {"lists of many cells", "clustered", on_device({{"tile_size", "8"}, {"slice_count", "128"}})},
            {"lists by waves", "clustered", on_device({{"loop", "wave"}, {"listing4", "printed"}})},
            {"lists of records", "clustered", on_device({{"lights", "duplicated"}})},
            {"trees", "tiled_light_trees", on_device()},
            {"trees of small leaves", "tiled_light_trees", on_device({{"leaf_size", "1"}, {"tile_size", "13"}})},
            {"trees by near ends", "tiled_light_trees", on_device({{"sort_key", "near"}, {"lds", "on"}})},
            {"trees of sorted tiles", "tiled_light_trees", on_device({{"sort", "cell"}})},
            {"hybrid", "hybrid_light_trees", on_device()},
            {"hybrid b", "hybrid_light_trees", on_device({{"heuristic", "b"}, {"paths", "three"}})},
            {"hybrid c", "hybrid_light_trees", on_device({{"heuristic", "c"}, {"sort_key", "near"}})},
            {"hybrid d", "hybrid_light_trees", on_device({{"heuristic", "d"}})},
            {"hybrid e", "hybrid_light_trees", on_device({{"heuristic", "e"}, {"leaf_size", "2"}, {"lds", "on"}})},
            {"hybrid lists", "hybrid_light_trees", on_device({{"heuristic", "lists"}, {"list_bounds", "lights"}})},
            {"hybrid of records", "hybrid_light_trees", on_device({{"lights", "duplicated"}, {"slice_count", "1"}})}};
}

std::vector<std::vector<std::byte>> bytes_of(const BuiltStructure& built) {
    std::vector<std::vector<std::byte>> bytes;
    for (const gpu::Buffer* buffer : built.buffers) bytes.push_back(buffer->download<std::byte>());
    return bytes;
}

std::string validated(const BuiltStructure& built, std::uint32_t light_count) {
    ManylightsSettings settings{};
    settings.size = sizeof settings;
    ManylightsBuilder* builder = nullptr;
    EXPECT_EQ(manylights_create(&settings, &builder, nullptr), MANYLIGHTS_OK);
    std::vector<std::vector<std::byte>> bytes = bytes_of(built);
    const ManylightsBuffers buffers{bytes[0].data(), bytes[1].data(), bytes[2].data(), bytes[3].data(),
                                    bytes[4].data()};
    const ManylightsSizes sizes{bytes[0].size(), bytes[1].size(), bytes[2].size(), bytes[3].size(), bytes[4].size()};
    ManylightsReport report{};
    const ManylightsStatus status = manylights_validate(builder, &buffers, &sizes, light_count, &report);
    manylights_destroy(builder);
    if (status == MANYLIGHTS_OK) return "";
    return std::string(report.field) + ": " + report.rule + ", element " + std::to_string(report.index);
}

// The validator asks that parents hold their children; a build has nothing to spare there.
void expect_unions(const std::vector<MlNode>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (ml_node_is_leaf(nodes[i].bits)) continue;
        const MlNode &left = nodes[i + 1], &right = nodes[i + 1 + ml_node_skip_count(left.bits)];
        ASSERT_EQ(nodes[i].min_depth, std::min(left.min_depth, right.min_depth)) << "node " << i;
        ASSERT_EQ(nodes[i].max_depth, std::max(left.max_depth, right.max_depth)) << "node " << i;
    }
}

class DeviceBuildTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const View& view, const char* technique, const OptionValues& options) {
        std::unique_ptr<Technique> made = make_technique(device(), technique, options);
        made->prepare(view.frame());
        return made;
    }

    WorkSummary work(const View& view, const char* technique, const OptionValues& options) {
        return summarize(prepared(view, technique, options)->record(view.frame()));
    }

    void expect_exact(const View& view, const std::string& what) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        for (const Variant& variant : variants()) {
            const VerifyResult result = compare(truth, records_of(device(), variant, view.frame()), view.width);
            EXPECT_EQ(result.wrong_pixels, 0u) << what << ", " << variant.label;
        }
    }

    void expect_valid(const View& view, const StructureOptions& options) {
        const std::unique_ptr<StructureBuild> build = make_device_build(device(), "trees", options);
        const BuiltStructure built = build->build(view.frame(), FrameLights(device(), view.frame()));
        EXPECT_EQ(validated(built, static_cast<std::uint32_t>(view.lights.size())), "");
        EXPECT_EQ(built.buffers[4]->bytes(), 4 * built.references);
        expect_unions(HostStructure(built.buffers).nodes);
    }

    std::string refusal(const View& view, const char* technique, const OptionValues& options) {
        try {
            prepared(view, technique, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

} // namespace

TEST_F(DeviceBuildTest, is_exact_for_every_count_and_size) {
    expect_exact(made_view(device(), 1, 1, 33), "33 lights at one pixel");
    for (const std::uint32_t count : {0u, 1u, 1500u}) {
        expect_exact(made_view(device(), 97, 60, count), std::to_string(count) + " lights");
    }
}

TEST_F(DeviceBuildTest, is_exact_for_lights_that_are_everywhere_or_in_one_place) {
    View view = made_view(device(), 97, 60, 700);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    expect_exact(view, "lights everywhere");
    view = made_view(device(), 97, 60, 700);
    for (Light& light : view.lights) light.sphere = view.lights.front().sphere;
    expect_exact(view, "all lights at one point");
    view = made_view(device(), 97, 60, 700);
    for (Light& light : view.lights) light.sphere.range *= 0.05f;
    view.lights[350].sphere.range = 1e4f;
    expect_exact(view, "a huge light among tiny ones");
    for (Light& light : view.lights) light.sphere.range = 0.0f;
    expect_exact(view, "no light in view");
}

// Points at the slices' edges as well, by the very floats that the shaders compare.
TEST_F(DeviceBuildTest, is_exact_for_lights_that_end_at_points_and_points_at_edges_of_slices) {
    View view = made_view(device(), 97, 60, 0);
    const SliceEdges edges = exponential_slices(5.0f, view.scene.view_extent, 16);
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        PointPosition& point = view.positions[pixel];
        if (point.depth == 0.0f || pixel % 2 == 0) continue;
        const float edge = edges[1 + pixel / 2 % 15];
        const float depth = pixel % 3 == 0 ? edge : std::nextafter(edge, pixel % 3 == 1 ? 0.0f : kInfinity);
        point.position *= depth / point.depth;
        point.depth = depth;
    }
    view.points.positions().upload(view.positions);
    add_lights_that_end_at_points(view);
    expect_exact(view, "lights that end at points");
}

// More lights in a cell than a leaf counts and than one tree's leaves hold.
TEST_F(DeviceBuildTest, is_valid_and_exact_for_70000_lights_in_a_tile) {
    View view = made_view(device(), 24, 24, 70000);
    for (Light& light : view.lights) light.sphere.range = 5.0f + 0.1f * light.sphere.range;
    for (std::size_t i = 0; i < view.lights.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            view.lights[i].sphere.center[axis] = view.camera.position[axis] + 4.0f * view.camera.forward[axis];
    StructureOptions options = structure_options(StructureKind::trees);
    options.leaf_size = 1;
    expect_valid(view, options);
    options = structure_options(StructureKind::hybrid);
    options.slice_count = 1;
    expect_valid(view, options);
    options.heuristic = paper::Heuristic::always_list;
    expect_valid(view, options);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    EXPECT_GT(std::ranges::max(truth, {}, &PixelRecord::affecting).affecting, 65535u);
    for (const Variant& variant :
         {Variant{"lists", "hybrid_light_trees", on_device({{"heuristic", "lists"}, {"paths", "three"}})},
          Variant{"trees", "tiled_light_trees", on_device({{"leaf_size", "1"}})}}) {
        const VerifyResult result = compare(truth, records_of(device(), variant, view.frame()), view.width);
        EXPECT_EQ(result.wrong_pixels, 0u) << variant.label;
    }
}

TEST_F(DeviceBuildTest, is_valid_by_the_library_and_its_parents_are_unions) {
    for (const std::uint32_t count : {0u, 1u, 2500u}) {
        const View view = made_view(device(), 97, 60, count);
        for (const StructureKind kind : kKinds) {
            for (const std::uint32_t leaf_size : {1u, 4u, 7u}) {
                StructureOptions options = structure_options(kind);
                options.leaf_size = leaf_size;
                expect_valid(view, options);
                options.tile_size = 9;
                options.heuristic = paper::Heuristic::always_tree;
                expect_valid(view, options);
            }
        }
    }
}

TEST_F(DeviceBuildTest, writes_the_same_bytes_in_every_run) {
    const View view = made_view(device(), 97, 60, 2500);
    const FrameLights lights(device(), view.frame());
    for (const StructureKind kind : kKinds) {
        const auto first = make_device_build(device(), "first", structure_options(kind));
        const auto second = make_device_build(device(), "second", structure_options(kind));
        const auto bytes = bytes_of(first->build(view.frame(), lights));
        EXPECT_EQ(bytes, bytes_of(second->build(view.frame(), lights)));
        EXPECT_EQ(bytes, bytes_of(first->build(view.frame(), lights))) << "once more";
    }
}

// Sorts are stable, so that lights of one depth, too, come in the same order.
TEST_F(DeviceBuildTest, writes_the_same_bytes_whatever_is_sorted) {
    View view = made_view(device(), 97, 60, 2500);
    for (std::size_t i = 0; i < 2500; i += 3) view.lights[i].sphere = view.lights[i / 2].sphere;
    const FrameLights lights(device(), view.frame());
    for (const StructureKind kind : {StructureKind::trees, StructureKind::hybrid}) {
        for (const paper::SortKey key : {paper::SortKey::center_depth, paper::SortKey::near_depth}) {
            StructureOptions options = structure_options(kind);
            options.sort_key = key;
            const auto global = make_device_build(device(), "global", options);
            options.sort_scope = paper::SortScope::each_cell;
            const auto cells = make_device_build(device(), "cells", options);
            EXPECT_EQ(bytes_of(global->build(view.frame(), lights)), bytes_of(cells->build(view.frame(), lights)));
        }
    }
}

TEST_F(DeviceBuildTest, has_a_leaf_for_every_light_where_the_leaf_size_is_1) {
    const View view = made_view(device(), 97, 60, 2500);
    StructureOptions options = structure_options(StructureKind::trees);
    options.leaf_size = 1;
    const auto build = make_device_build(device(), "trees", options);
    const HostStructure structure(build->build(view.frame(), FrameLights(device(), view.frame())).buffers);
    std::size_t lights = 0;
    float before = -kInfinity;
    const MlCell& tile = structure.cells.front();
    for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
        const MlNode& node = structure.nodes[i];
        if (!ml_node_is_leaf(node.bits) || ml_node_light_count(node.bits) == 0) continue;
        EXPECT_LE(before, 0.5f * (node.min_depth + node.max_depth) * 1.0001f) << "centres ascend";
        before = 0.5f * (node.min_depth + node.max_depth);
        ++lights;
    }
    EXPECT_GT(lights, 100u);
}

// Its bounds and those of the paper's pipeline are written apart from each other, and so is their slack.
TEST_F(DeviceBuildTest, does_the_work_of_the_papers_pipeline) {
    const View view = made_view(device(), 97, 60, 3000);
    for (const char* technique : kTechniques) {
        const std::unique_ptr<Technique> host = prepared(view, technique, {{"producer", "paper"}});
        const std::unique_ptr<Technique> gpu = prepared(view, technique, on_device());
        const WorkSummary expected = summarize(host->record(view.frame())), got = summarize(gpu->record(view.frame()));
        EXPECT_NEAR(got.tested_mean, expected.tested_mean, 0.02 * expected.tested_mean) << technique;
        EXPECT_NEAR(got.nodes_mean, expected.nodes_mean, 0.02 * expected.nodes_mean) << technique;
        const auto references = static_cast<double>(host->stats().references);
        EXPECT_NEAR(static_cast<double>(gpu->stats().references), references, 0.05 * references) << technique;
    }
}

// Each heuristic chooses as the host's does, but for cells on the verge: measured by the tests and the nodes of all.
TEST_F(DeviceBuildTest, chooses_trees_as_the_papers_pipeline_does) {
    View view = made_view(device(), 97, 60, 3000);
    for (Light& light : view.lights) light.sphere.range *= 0.5f;
    std::vector<double> nodes;
    for (const char* heuristic : {"a", "b", "c", "d", "e"}) {
        const OptionValues options{{"heuristic", heuristic}, {"tile_size", "16"}, {"leaf_size", "1"}};
        OptionValues on_host = options;
        on_host.emplace_back("producer", "paper");
        const WorkSummary expected = work(view, "hybrid_light_trees", on_host),
                          got = work(view, "hybrid_light_trees", on_device(options));
        EXPECT_NEAR(got.nodes_mean, expected.nodes_mean, 0.03 * expected.nodes_mean) << heuristic;
        EXPECT_NEAR(got.tested_mean, expected.tested_mean, 0.03 * expected.tested_mean) << heuristic;
        nodes.push_back(got.nodes_mean);
    }
    for (const std::size_t other : {0, 1, 3}) EXPECT_NE(nodes[other], nodes[4]) << "not every cell gets a tree";
}

TEST_F(DeviceBuildTest, follows_its_options) {
    const View view = made_view(device(), 97, 60, 3000);
    const auto tested = [&](const char* technique, const OptionValues& options) {
        return work(view, technique, on_device(options)).tested_mean;
    };
    const char* const hybrid = "hybrid_light_trees";
    const double lists = tested("clustered", {});
    EXPECT_EQ(tested(hybrid, {{"heuristic", "lists"}}), lists);
    EXPECT_LT(tested(hybrid, {{"heuristic", "lists"}, {"tile_size", "8"}, {"list_bounds", "lights"}}),
              tested(hybrid, {{"heuristic", "lists"}, {"tile_size", "8"}}));
    EXPECT_LT(tested(hybrid, {}), lists);
    EXPECT_LT(tested(hybrid, {{"heuristic", "e"}}), tested(hybrid, {}));
    EXPECT_LE(tested(hybrid, {{"heuristic", "c"}}), tested(hybrid, {}));
    EXPECT_NE(tested(hybrid, {{"heuristic", "b"}}), tested(hybrid, {}));
    EXPECT_LT(tested(hybrid, {{"heuristic", "d"}}), lists);
    EXPECT_GT(tested("clustered", {{"listing4", "printed"}}), lists);
    EXPECT_LT(tested("clustered", {{"tile_size", "16"}}), lists);
    EXPECT_LT(tested("clustered", {{"slice_count", "64"}}), lists);
    EXPECT_NE(tested("tiled_light_trees", {{"sort_key", "near"}}), tested("tiled_light_trees", {}));
    EXPECT_LT(tested("tiled_light_trees", {{"leaf_size", "1"}}), tested("tiled_light_trees", {}));
}

TEST_F(DeviceBuildTest, duplicates_lights) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* technique : kTechniques) {
        const TechniqueStats indexed = prepared(view, technique, on_device())->stats();
        const auto duplicated = prepared(view, technique, on_device({{"lights", "duplicated"}}));
        EXPECT_EQ(duplicated->stats().structure_bytes - indexed.structure_bytes,
                  indexed.references * (sizeof(LightRecord) - sizeof(std::uint32_t)));
        EXPECT_EQ(duplicated->shade(view.frame()), prepared(view, technique, on_device())->shade(view.frame()));
    }
}

TEST_F(DeviceBuildTest, reports_its_stages) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* technique : kTechniques) {
        const TechniqueStats stats = prepared(view, technique, on_device())->stats();
        std::string names;
        double sum = 0.0;
        for (const NamedTimes& stage : stats.stages) names += stage.name + ' ', sum += stage.ms.front();
        EXPECT_EQ(names, technique == kTechniques[0] ? "cull sort bin write " : "cull sort bin tree write ");
        EXPECT_NEAR(stats.build_ms.front(), sum, 1e-9);
    }
}

TEST_F(DeviceBuildTest, refuses_what_cannot_be_sorted) {
    View view = made_view(device(), 97, 60, 50000);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    const std::string message = refusal(view, "clustered", on_device({{"tile_size", "8"}}));
    for (const char* word : {"clustered", "83200000 references", "67108864", "larger tiles"})
        EXPECT_NE(message.find(word), std::string::npos) << message;
    VisibleLights lights(device());
    DepthOrder order(device(), false);
    GridReferences references(device(), "huge");
    const gpu::Buffer edges(device(), "edges", 8);
    try {
        references.find({{8192, 8192, 65536, 65536}, 2, edges}, lights, order);
        ADD_FAILURE() << "more cells than a prefix sum takes were accepted";
    } catch (const InputError& error) {
        for (const char* word : {"huge", "134217728 cells", "67108864"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

} // namespace manylights::lab
