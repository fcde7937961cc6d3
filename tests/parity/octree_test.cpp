// An octree over the froxels that have samples: the same froxels whichever way they are found, the same lists from
// either form of nodes, and inner nodes that save references and change nothing of what a point tests.

#include "lab/scene/error.h"
#include "lab/techniques/octree/octree_nodes.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <set>

namespace manylights::lab {
namespace {

struct Result {
    std::vector<PixelRecord> records;
    TechniqueStats stats;
};

class OctreeTest : public TechniquesTest {
  protected:
    Result run(const View& view, const OptionValues& options, const char* name = "octree") const {
        const std::unique_ptr<Technique> technique = make_technique(device(), name, options);
        technique->prepare(view.frame());
        std::vector<PixelRecord> records = technique->record(view.frame());
        return {std::move(records), technique->stats()};
    }

    void expect_exact(const View& view, const OptionValues& options, const std::string& what) const {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        EXPECT_TRUE(compare(truth, run(view, options).records, view.width).exact()) << what;
    }
};

std::vector<std::uint32_t> tested_of(const Result& result) {
    std::vector<std::uint32_t> tested;
    for (const PixelRecord& record : result.records) tested.push_back(record.tested);
    return tested;
}

/// Froxels that have samples, by the grid's own buffer: tiles across and down, pixels across and down, slices, edges.
std::set<std::uint32_t> cells_with_samples(const View& view, const FroxelGrid& grid) {
    const TileGrid& tiles = grid.tiles();
    const std::vector<float> edges = grid.buffer().download<float>(grid.slice_count() + 1, 5 * sizeof(float));
    std::set<std::uint32_t> cells;
    for (std::uint32_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const float depth = view.positions[pixel].depth;
        if (depth == 0.0f) continue;
        const std::uint32_t x = pixel % view.width * tiles.tiles_x / view.width;
        const std::uint32_t y = pixel / view.width * tiles.tiles_y / view.height;
        const auto slice = static_cast<std::uint32_t>(std::ranges::upper_bound(edges, depth) - edges.begin() - 1);
        cells.insert((y * tiles.tiles_x + x) * grid.slice_count() + slice);
    }
    return cells;
}

glm::uvec3 froxel_at(std::uint32_t cell, const FroxelGrid& grid) {
    const std::uint32_t tile = cell / grid.slice_count();
    return {tile % grid.tiles().tiles_x, tile / grid.tiles().tiles_x, cell % grid.slice_count()};
}

/// How many nodes there are above these froxels.
std::uint32_t parent_count(const std::set<std::uint32_t>& cells, const FroxelGrid& grid, std::uint32_t levels) {
    std::set<std::array<std::uint32_t, 4>> parents;
    for (const std::uint32_t cell : cells) {
        const glm::uvec3 at = froxel_at(cell, grid);
        for (std::uint32_t level = 1; level < levels; ++level)
            parents.insert({level, at.x >> level, at.y >> level, at.z >> level});
    }
    return static_cast<std::uint32_t>(parents.size());
}

/// The node of a froxel, from the root down; 0 where the way ends before.
std::uint32_t leaf_of(const std::vector<std::uint32_t>& children, const glm::uvec3& at, std::uint32_t levels) {
    std::uint32_t node = 0;
    for (std::uint32_t level = levels - 1; level-- > 0;) {
        if (children[node] == 0) return 0;
        node = children[node] + (at.x >> level & 1) + 2 * (at.y >> level & 1) + 4 * (at.z >> level & 1);
    }
    return node;
}

View sky(gpu::Device& device) {
    View view = made_view(device, 33, 20, 40);
    for (PointPosition& point : view.positions) point = {glm::vec3(0.0f), 0.0f};
    view.points.positions().upload(view.positions);
    return view;
}

// Lights that reach far beyond froxels.
View large_lights(gpu::Device& device) {
    View view = made_view(device, 97, 60, 400);
    for (Light& light : view.lights) light.sphere.range *= 5.0f;
    return view;
}

const std::vector<FroxelOptions> kGrids{{},
                                        {{60, 34}, DepthDivision::exponential, 0},
                                        {{32, 32}, DepthDivision::view_uniform, 256},
                                        {{7, 5}, DepthDivision::screen_uniform, 31},
                                        {{130, 3}, DepthDivision::exponential, 1}, // more tiles than pixels
                                        {{1, 1}, DepthDivision::view_uniform, 1},
                                        {{1, 2}, DepthDivision::view_uniform, 4096}};

TEST_F(OctreeTest, froxels_are_those_with_samples_whichever_way_they_are_found) {
    FroxelGrid grid(device());
    const std::unique_ptr<OccupiedCells> ways[] = {make_cells_by_bits(device()), make_cells_by_sort(device(), false),
                                                   make_cells_by_sort(device(), true)};
    for (const View& view : {made_view(device(), 97, 60, 0), made_view(device(), 1, 1, 0), sky(device())}) {
        for (const FroxelOptions& options : kGrids) {
            grid.lay_out(view.frame(), options);
            const std::set<std::uint32_t> expected = cells_with_samples(view, grid);
            for (const std::unique_ptr<OccupiedCells>& way : ways) {
                way->find(view.frame(), grid);
                const std::vector<std::uint32_t> cells = way->cells().download<std::uint32_t>();
                EXPECT_EQ(way->count(), expected.size());
                EXPECT_TRUE(std::ranges::equal(cells, expected)) << options.tiles[0] << " tiles across";
            }
        }
    }
}

TEST_F(OctreeTest, sparse_nodes_are_the_children_of_nodes_with_samples) {
    FroxelGrid grid(device());
    OctreeLevels levels(device());
    const auto cells = make_cells_by_bits(device());
    const auto nodes = make_sparse_nodes(device());
    const View view = made_view(device(), 97, 60, 0);
    for (const FroxelOptions& options : kGrids) {
        grid.lay_out(view.frame(), options);
        levels.lay_out(grid, true);
        cells->find(view.frame(), grid);
        nodes->build(grid, levels, *cells);
        const std::set<std::uint32_t> expected = cells_with_samples(view, grid);
        const std::uint32_t parents = parent_count(expected, grid, levels.count());
        EXPECT_EQ(nodes->count(), 8 + 8 * parents); // the root has no siblings, and room for them
        const std::vector<std::uint32_t> children = nodes->nodes().download<std::uint32_t>();
        EXPECT_EQ(children.size() - std::ranges::count(children, 0u), parents + expected.size());
        std::set<std::uint32_t> leaves;
        for (const std::uint32_t cell : expected)
            leaves.insert(leaf_of(children, froxel_at(cell, grid), levels.count()));
        EXPECT_EQ(leaves.size(), expected.size());
        for (const std::uint32_t leaf : leaves) EXPECT_EQ(children[leaf], 1u);
    }
}

TEST_F(OctreeTest, leaves_have_the_lists_of_hybrid_lighting) {
    const View view = made_view(device(), 97, 60, 700);
    const Result leaves = run(view, {{"inner", "off"}});
    const Result froxels = run(view, {{"cells", "occupied"}}, "hybrid_lighting");
    EXPECT_EQ(leaves.stats.references, froxels.stats.references);
    EXPECT_EQ(tested_of(leaves), tested_of(froxels));
}

TEST_F(OctreeTest, inner_nodes_save_references_and_no_point_tests_another_light) {
    const View view = large_lights(device());
    for (const char* tiles : {"30x17", "60x34", "7x5"}) {
        const Result with = run(view, {{"tiles", tiles}}), without = run(view, {{"tiles", tiles}, {"inner", "off"}});
        EXPECT_LT(with.stats.references, without.stats.references) << tiles;
        EXPECT_EQ(tested_of(with), tested_of(without)) << tiles;
    }
}

TEST_F(OctreeTest, lists_are_the_same_from_either_form_of_nodes_and_either_kind_of_corners) {
    const View view = large_lights(device());
    const Result sparse = run(view, {});
    for (const OptionValues& options :
         {OptionValues{{"nodes", "dense"}}, OptionValues{{"corners", "computed"}},
          OptionValues{{"nodes", "dense"}, {"corners", "computed"}, {"unique", "sort"}}}) {
        const Result other = run(view, options);
        EXPECT_EQ(other.stats.references, sparse.stats.references) << options.front().first;
        EXPECT_EQ(tested_of(other), tested_of(sparse)) << options.front().first;
    }
}

TEST_F(OctreeTest, lists_are_the_same_whether_lights_go_down_once_or_in_each_tile) {
    const View view = large_lights(device());
    for (OptionValues options : {OptionValues{{"tiles", "30x17"}}, OptionValues{{"tiles", "7x5"}, {"inner", "off"}},
                                 OptionValues{{"tiles", "130x3"}}, OptionValues{{"tiles", "1x1"}}}) {
        const Result once = run(view, options);
        options.push_back({"assign", ""});
        for (const char* assign : {"tiles", "billboards"}) {
            options.back().second = assign;
            const Result in_tiles = run(view, options);
            EXPECT_EQ(in_tiles.stats.references, once.stats.references) << options.front().second << assign;
            EXPECT_EQ(tested_of(in_tiles), tested_of(once)) << options.front().second << assign;
        }
    }
}

// The root alone holds what is everywhere.
TEST_F(OctreeTest, store_once_what_reaches_every_froxel) {
    View view = made_view(device(), 65, 40, 30);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    for (const char* nodes : {"sparse", "dense"}) {
        for (const char* tiles : {"30x17", "1x1", "5x1"})
            EXPECT_EQ(run(view, {{"nodes", nodes}, {"tiles", tiles}}).stats.references, 30u) << nodes << tiles;
        EXPECT_GT(run(view, {{"nodes", nodes}, {"inner", "off"}}).stats.references, 3000u) << nodes;
        expect_exact(view, {{"nodes", nodes}}, nodes);
    }
}

TEST_F(OctreeTest, are_exact_for_grids_of_every_shape) {
    const View views[] = {made_view(device(), 97, 60, 700), made_view(device(), 1, 1, 50), large_lights(device()),
                          sky(device())};
    const char* tiles[] = {"30x17", "7x5", "130x3", "1x1"};
    for (const View& view : views) {
        for (std::size_t i = 0; i < std::size(tiles); ++i) {
            const OptionValues options{{"tiles", tiles[i]},
                                       {"division", i % 2 != 0 ? "screen_uniform" : "view_uniform"},
                                       {"slices", i == 3 ? "1" : "33"},
                                       {"nodes", i % 2 != 0 ? "dense" : "sparse"}};
            expect_exact(view, options, tiles[i]);
        }
    }
}

// Corners are computed anew where the projection changes.
TEST_F(OctreeTest, are_the_same_when_they_are_built_again_and_after_another_camera) {
    View view = large_lights(device());
    const std::uint64_t first = run(view, {}).stats.references;
    const auto technique = make_technique(device(), "octree", {});
    technique->prepare(view.frame());
    technique->rebuild(view.frame());
    EXPECT_EQ(technique->stats().references, first);
    EXPECT_EQ(technique->stats().build_ms.size(), 2u);
    view.camera.vertical_fov = 0.4f;
    view.camera.near_plane = 1.0f;
    const std::uint64_t narrow = run(view, {}).stats.references;
    EXPECT_NE(narrow, first);
    technique->prepare(view.frame());
    EXPECT_EQ(technique->stats().references, narrow);
}

TEST_F(OctreeTest, say_what_they_serve) {
    const auto technique = make_technique(device(), "octree", {});
    EXPECT_TRUE(technique->info().needs_depth);
    EXPECT_TRUE(technique->info().exact);
    EXPECT_FALSE(technique->info().serves_air);
    EXPECT_FALSE(technique->info().serves_translucent);
}

TEST_F(OctreeTest, refuse_more_nodes_than_can_be_counted) {
    const View view = made_view(device(), 33, 20, 5);
    const auto technique =
        make_technique(device(), "octree", {{"tiles", "200x200"}, {"slices", "4000"}, {"nodes", "dense"}});
    try {
        technique->prepare(view.frame());
        ADD_FAILURE() << "is not refused";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("200 x 200 tiles of 4000 slices"), std::string::npos) << error.what();
    }
    expect_exact(view, {{"tiles", "200x200"}, {"slices", "4000"}, {"corners", "computed"}}, "sparse");
}

} // namespace
} // namespace manylights::lab
