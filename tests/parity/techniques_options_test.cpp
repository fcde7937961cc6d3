// Options that do not fit are refused in one line that names the key, the value and what is allowed.

#include "lab/scene/error.h"
#include "lab/techniques/structure_options.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>

namespace manylights::lab {

namespace {

std::string refusal(gpu::Device& device, const char* technique, const OptionValues& options) {
    try {
        make_technique(device, technique, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void expect_words(const std::string& message, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in '" << message << "'";
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

} // namespace

TEST_F(TechniquesTest, unknown_technique_names_the_choices) {
    const std::string message = refusal(device(), "magic", {});
    expect_words(message, {"magic", "brute_force", "exact", "clustered", "tiled_light_trees", "hybrid_light_trees",
                           "depth_windows", "depth_windows_wave", "tiled", "culling_2_5d", "clustered_samples",
                           "z_bins", "octree", "hybrid_lighting", "light_linked_list", "light_volumes"});
}

TEST_F(TechniquesTest, unknown_option_names_the_keys) {
    expect_words(refusal(device(), "clustered", {{"leaf_size", "4"}}),
                 {"clustered", "leaf_size", "tile_size", "producer"});
    for (const char* name : {"tiled_light_trees", "hybrid_light_trees", "depth_windows"})
        for (const char* key : {"cell_test", "loop"})
            expect_words(refusal(device(), name, {{key, "tight"}}), {name, key});
    expect_words(refusal(device(), "tiled_light_trees", {{"paths", "three"}}), {"paths", "leaf_size"});
    for (const char* key : {"leaf_size", "heuristic", "paths", "lds", "sort", "tree", "entry", "list_bounds"})
        expect_words(refusal(device(), "clustered", {{key, "4"}}), {"clustered", key, "slice_count"});
    for (const char* key : {"build", "lights", "lds", "paths"})
        expect_words(refusal(device(), "depth_windows", {{key, "on"}}), {"depth_windows", key, "tile_size"});
    for (const char* key : {"slice_count", "leaf_size", "producer"})
        expect_words(refusal(device(), "depth_windows", {{key, "4"}}), {"depth_windows", key, "tile_size", "depth"});
    for (const char* name : {"brute_force", "exact"})
        expect_words(refusal(device(), name, {{"tile_size", "48"}}), {name, "tile_size"});
}

TEST_F(TechniquesTest, values_out_of_range_name_the_range) {
    for (const char* name : {"clustered", "depth_windows"})
        for (const char* value : {"7", "4097", "0", "-1", "48px", "", "99999999999", "1e2"})
            expect_words(refusal(device(), name, {{"tile_size", value}}), {name, "tile_size", "8", "4096"});
    for (const char* value : {"0", "129"})
        expect_words(refusal(device(), "hybrid_light_trees", {{"slice_count", value}}), {"slice_count", "1", "128"});
    for (const char* value : {"0", "65536"})
        expect_words(refusal(device(), "tiled_light_trees", {{"leaf_size", value}}), {"leaf_size", "1", "65535"});
    for (const char* value : {"0", "-5", "nan", "inf", "far"})
        expect_words(refusal(device(), "clustered", {{"slice_near", value}}), {"slice_near", value});
    for (const char* value : {"", "128", "subgroups"})
        expect_words(refusal(device(), "depth_windows_wave", {{"wave", value}}),
                     {"depth_windows_wave", "wave", "subgroup, 4, 8, 16, 32, 64"});
    for (const char* value : {"", "48", "128", "8px"})
        expect_words(refusal(device(), "z_bins", {{"tile_size", value}}), {"z_bins", "tile_size", "8, 16, 32, 64"});
    expect_words(refusal(device(), "z_bins", {{"bins", "8191"}}), {"bins", "8191", "1024, 2048, 4096, 8192"});
    expect_words(refusal(device(), "z_bins", {{"spacing", "even"}}), {"spacing", "even", "linear, log"});
    expect_words(refusal(device(), "z_bins", {{"summary", "1"}}), {"summary", "1", "off, on"});
    expect_words(refusal(device(), "z_bins", {{"loop", "group"}}), {"loop", "group", "lane, wave"});
    expect_words(refusal(device(), "z_bins", {{"sort_key", "far"}}), {"sort_key", "far", "centre, near"});
    expect_words(refusal(device(), "octree", {{"unique", "hash"}}), {"unique", "hash", "bitmask, sort, compact_sort"});
    expect_words(refusal(device(), "octree", {{"nodes", "full"}}), {"nodes", "full", "sparse, dense"});
    expect_words(refusal(device(), "octree", {{"corners", "none"}}), {"corners", "none", "table, computed"});
    expect_words(refusal(device(), "octree", {{"assign", "pixels"}}),
                 {"assign", "pixels", "lights, tiles, billboards"});
    expect_words(refusal(device(), "octree", {{"inner", "yes"}}), {"inner", "yes", "on, off"});
    expect_words(refusal(device(), "clustered", {{"producer", "magic"}}), {"producer", "magic", "library", "paper"});
    for (const char* value : {"1", "yes", ""})
        expect_words(refusal(device(), "depth_windows", {{"depth", value}}), {"depth_windows", "depth=", "off, on"});
    expect_words(refusal(device(), "clustered", {{"cell_test", "Tight"}}), {"cell_test", "Tight", "box, tight"});
    expect_words(refusal(device(), "clustered", {{"loop", "1"}}), {"loop", "1", "lane, wave"});
    for (const char* name : {"tiled", "culling_2_5d"})
        for (const char* value : {"7", "65", "16px", ""})
            expect_words(refusal(device(), name, {{"tile_size", value}}), {name, "tile_size", "8", "64"});
    expect_words(refusal(device(), "tiled", {{"tiles", "32"}}), {"tiled", "tiles=32", "1 to 4096"});
    expect_words(refusal(device(), "tiled", {{"depth", "min"}}), {"tiled", "depth=min", "minmax, max, none"});
    expect_words(refusal(device(), "tiled", {{"test", "cone"}}), {"test=cone", "narrowed, rectangle, planes"});
    expect_words(refusal(device(), "culling_2_5d", {{"variant", "d"}}), {"culling_2_5d", "variant=d", "a, b, c"});
    expect_words(refusal(device(), "culling_2_5d", {{"cells", "33"}}), {"cells=33", "8", "16", "32", "64"});
    expect_words(refusal(device(), "culling_2_5d", {{"interval", "tile"}}), {"interval=tile", "narrowed, sphere"});
    for (const char* value : {"8", "48", "032"})
        expect_words(refusal(device(), "clustered_samples", {{"tile_size", value}}), {"tile_size", value, "32, 16"});
    expect_words(refusal(device(), "clustered_samples", {{"unique", "hash"}}), {"hash", "sort, page_table, bitmap"});
    expect_words(refusal(device(), "clustered_samples", {{"bounds", "tight"}}), {"tight", "implicit, explicit"});
    expect_words(refusal(device(), "clustered_samples", {{"fan_out", "64"}}), {"fan_out", "64", "32, 16, 8"});
    expect_words(refusal(device(), "clustered_samples", {{"normals", "1"}}), {"normals", "off, on"});
    expect_words(refusal(device(), "clustered_samples", {{"query", "list"}}), {"query", "clusters, hierarchy"});
    for (const char* value : {"", "30", "x17", "30x", "0x17", "30x4097", "30x17x2", "30,17"})
        expect_words(refusal(device(), "hybrid_lighting", {{"tiles", value}}),
                     {"hybrid_lighting", "tiles=", "1 to 4096"});
    for (const char* value : {"0", "4097"})
        expect_words(refusal(device(), "hybrid_lighting", {{"slices", value}}), {"slices=", value, "1 to 4096"});
    expect_words(refusal(device(), "hybrid_lighting", {{"division", "log"}}),
                 {"division=log", "exponential, view_uniform, screen_uniform"});
    expect_words(refusal(device(), "hybrid_lighting", {{"billboards", "quads"}}), {"quads", "compute, raster"});
    expect_words(refusal(device(), "hybrid_lighting", {{"lists", "L"}}), {"lists=L", "contiguous, linked"});
    expect_words(refusal(device(), "hybrid_lighting", {{"cells", "some"}}), {"cells=some", "all, occupied"});
    expect_words(refusal(device(), "hybrid_lighting", {{"coverage", "ray"}}),
                 {"coverage=ray", "tile, centre_ray, plain"});
    expect_words(refusal(device(), "light_linked_list", {{"resolution", "half"}}), {"half", "eighth, quarter, full"});
    expect_words(refusal(device(), "light_linked_list", {{"link_bytes", "4"}}), {"link_bytes=4", "8, 12, 16"});
    expect_words(refusal(device(), "light_linked_list", {{"depth_test", "1"}}), {"depth_test=1", "on, off"});
    expect_words(refusal(device(), "light_linked_list", {{"first_links", "257"}}), {"first_links", "0", "256"});
    expect_words(refusal(device(), "light_linked_list", {{"lossy", "on"}}), {"off, centre, coverage, rounding"});
    expect_words(refusal(device(), "light_volumes", {{"volume", "cone"}}), {"cone", "back, front, all, rectangle"});
    expect_words(refusal(device(), "light_volumes", {{"mesh_level", "4"}}), {"mesh_level", "0", "3"});
    expect_words(refusal(device(), "light_volumes", {{"order", "far"}}), {"order", "far", "index, near"});
    const OptionValues heuristic{{"producer", "paper"}, {"heuristic", "f"}};
    expect_words(refusal(device(), "hybrid_light_trees", heuristic), {"heuristic", "f", "a, b, c, d, e, lists"});
    expect_words(refusal(device(), "clustered", {{"build", "gpu"}}), {"build=gpu", "host, device"});
    expect_words(refusal(device(), "clustered", {{"lights", "copied"}}), {"lights=copied", "indexed, duplicated"});
    expect_words(refusal(device(), "hybrid_light_trees", {{"paths", "3"}}), {"paths=3", "one, three"});
    expect_words(refusal(device(), "tiled_light_trees", {{"lds", "1"}}), {"lds=1", "off, on"});
    const auto with_paper = [](const char* key, const char* value) {
        return OptionValues{{"producer", "paper"}, {key, value}};
    };
    expect_words(refusal(device(), "tiled_light_trees", with_paper("sort", "tile")), {"sort=tile", "global, cell"});
    expect_words(refusal(device(), "tiled_light_trees", with_paper("tree", "wide")), {"tree=wide", "top_down"});
    expect_words(refusal(device(), "tiled_light_trees", with_paper("entry", "leaf")), {"entry=leaf", "root, slice"});
    expect_words(refusal(device(), "hybrid_light_trees", with_paper("list_bounds", "none")),
                 {"list_bounds=none", "infinite, lights"});
}

TEST_F(TechniquesTest, options_that_contradict_each_other_are_refused) {
    expect_words(refusal(device(), "clustered", {{"slice_near", "9"}, {"slice_far", "9"}}),
                 {"slice_near", "slice_far"});
    expect_words(refusal(device(), "clustered", {{"tile_size", "16"}, {"tile_size", "32"}}), {"tile_size", "twice"});
    expect_words(refusal(device(), "hybrid_light_trees", {{"heuristic", "a"}}), {"heuristic", "producer=paper"});
    for (const char* key : {"sort_key", "sort", "tree", "entry"})
        expect_words(refusal(device(), "tiled_light_trees", {{key, ""}}), {"tiled_light_trees", key, "producer=paper"});
    for (const char* key : {"slice_count", "slice_near", "slice_far"})
        for (const OptionValues& options : {OptionValues{{key, "4"}}, OptionValues{{key, "4"}, {"build", "device"}}})
            expect_words(refusal(device(), "tiled_light_trees", options), {"tiled_light_trees", key, "entry=slice"});
    for (const auto& [key, value] : OptionValues{{"producer", "paper"}, {"tree", "top_down"}})
        expect_words(refusal(device(), "hybrid_light_trees", {{"build", "device"}, {key, value}}),
                     {"hybrid_light_trees", key, "not with build=device"});
    expect_words(refusal(device(), "tiled_light_trees", {{"build", "device"}, {"entry", "slice"}}),
                 {"entry", "not with build=device"});
    expect_words(refusal(device(), "clustered", {{"build", "device"}, {"cell_test", "tight"}}),
                 {"cell_test", "not with build=device"});
    expect_words(refusal(device(), "clustered", {{"loop", "wave"}, {"lights", "duplicated"}}),
                 {"lights=duplicated", "not with loop=wave"});
    expect_words(refusal(device(), "clustered", {{"producer", "library"}, {"cell_test", "tight"}}),
                 {"clustered", "cell_test=tight", "producer=paper"});
    expect_words(refusal(device(), "clustered", {{"loop", "wave"}, {"producer", "library"}}),
                 {"clustered", "loop=wave", "producer=paper"});
    expect_words(refusal(device(), "tiled", {{"tile_size", "16"}, {"tiles", "8x8"}}), {"tiled", "tile_size", "tiles"});
    expect_words(refusal(device(), "light_volumes", {{"volume", "rectangle"}, {"mesh_level", "1"}}),
                 {"light_volumes", "mesh_level", "volume=rectangle"});
    for (const auto& [key, value] :
         OptionValues{{"tile_size", "16"}, {"normals", "off"}, {"unique", "sort"}, {"bounds", "explicit"}})
        expect_words(refusal(device(), "clustered_samples", {{"query", "hierarchy"}, {key, value}}),
                     {"clustered_samples", key, "query=clusters"});
}

// What only the paper's pipeline can do chooses it, and its other switches with it.
TEST_F(TechniquesTest, tight_cells_and_the_loop_of_waves_choose_the_producer) {
    for (const OptionValues& options :
         {OptionValues{{"cell_test", "tight"}}, OptionValues{{"loop", "wave"}, {"listing4", "printed"}},
          OptionValues{{"cell_test", "tight"}, {"producer", "paper"}},
          OptionValues{{"loop", "wave"}, {"build", "device"}},
          OptionValues{{"cell_test", "box"}, {"loop", "lane"}, {"producer", "library"}}})
        EXPECT_EQ(refusal(device(), "clustered", options), "");
    const auto producer_with = [](const OptionValues& options) {
        return read_structure_options(technique_infos()[2], StructureKind::lists, options).producer;
    };
    EXPECT_EQ(producer_with({}), ProducerKind::library);
    EXPECT_EQ(producer_with({{"cell_test", "box"}, {"loop", "lane"}}), ProducerKind::library);
    EXPECT_EQ(producer_with({{"cell_test", "tight"}}), ProducerKind::paper);
    EXPECT_EQ(producer_with({{"loop", "wave"}}), ProducerKind::paper);
}

TEST(Techniques, infos_name_every_technique_and_their_options) {
    const std::vector<TechniqueInfo> infos = technique_infos();
    ASSERT_EQ(infos.size(), 15u);
    EXPECT_EQ(infos[0].name, "brute_force");
    EXPECT_EQ(infos[1].name, "exact");
    for (const TechniqueInfo& info : infos) EXPECT_FALSE(info.summary.empty());
    EXPECT_TRUE(
        std::ranges::any_of(infos[4].options, [](const OptionInfo& option) { return option.key == "leaf_size"; }));
}

TEST(Techniques, slices_follow_the_scene) {
    Scene scene;
    scene.view_extent = 500.0f;
    EXPECT_EQ(slice_range({}, scene).near_edge, 5.0f);
    EXPECT_EQ(slice_range({}, scene).far_edge, 500.0f);
    scene.view_extent = 3.0f;
    EXPECT_LT(slice_range({}, scene).near_edge, slice_range({}, scene).far_edge);
    StructureOptions options;
    options.slice_near = 4.0f;
    EXPECT_THROW(slice_range(options, scene), InputError);
}

} // namespace manylights::lab
