// Hybrid lighting: what is special about it. That it finds the lights of brute force is tested with all techniques.

#include "lab/techniques/device/froxel_grid.h"
#include "lab/techniques/device/tile_links.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>

namespace manylights::lab {
namespace {

class HybridLightingTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const OptionValues& options, const View& view) const {
        std::unique_ptr<Technique> technique = make_technique(device(), "hybrid_lighting", options);
        technique->prepare(view.frame());
        return technique;
    }

    std::uint64_t references(const OptionValues& options, const View& view) const {
        return prepared(options, view)->stats().references;
    }

    double tested(const OptionValues& options, const View& view) const {
        return summarize(prepared(options, view)->record(view.frame())).tested_mean;
    }

    VerifyResult verified(Technique& technique, const View& view) const {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        return compare(truth, technique.record(view.frame()), view.width);
    }

    void expect_exact(const OptionValues& options, const View& view) const {
        const VerifyResult result = verified(*prepared(options, view), view);
        EXPECT_TRUE(result.exact()) << ::testing::PrintToString(options) << ": " << result.wrong_pixels << " pixels";
    }
};

const OptionValues kLinked{{"lists", "linked"}};
const OptionValues kRaster{{"billboards", "raster"}};

// Halfway to the camera on the same rays.
void bring_points_closer(View& view) {
    for (PointPosition& point : view.positions) point = {0.5f * point.position, 0.5f * point.depth};
    view.points.positions().upload(view.positions);
}

} // namespace

// 30 x 17 tiles, near plane at 0.1, extent of 100, a field of 60 degrees from top to bottom: 106 slices.
TEST_F(HybridLightingTest, slices_are_as_deep_as_tiles_are_high_or_as_many_as_asked_for) {
    View view = made_view(device(), 1, 1, 0);
    view.scene.view_extent = 100.0f;
    view.camera.vertical_fov = glm::radians(60.0f);
    FroxelGrid grid(device());
    const auto slices = [&](DepthDivision division, std::uint32_t count, std::uint32_t tiles_y) {
        grid.lay_out(view.frame(), {{30, tiles_y}, division, count});
        EXPECT_EQ(grid.froxel_count(), 30 * tiles_y * grid.slice_count());
        return grid.slice_count();
    };
    EXPECT_EQ(slices(DepthDivision::exponential, 0, 17), 106u);
    EXPECT_EQ(slices(DepthDivision::exponential, 0, 34), 207u);
    EXPECT_EQ(slices(DepthDivision::exponential, 77, 17), 77u);
    EXPECT_EQ(slices(DepthDivision::view_uniform, 0, 17), 128u);
    EXPECT_EQ(slices(DepthDivision::screen_uniform, 256, 17), 256u);
    view.scene.view_extent = 0.01f; // in front of the near plane
    EXPECT_EQ(slices(DepthDivision::screen_uniform, 3, 17), 3u);
}

TEST_F(HybridLightingTest, finer_froxels_test_fewer_lights) {
    const View view = made_view(device(), 97, 60, 1500);
    EXPECT_LT(tested({{"tiles", "30x17"}}, view), tested({{"tiles", "7x5"}}, view));
    EXPECT_LT(tested({{"tiles", "97x60"}}, view), tested({{"tiles", "30x17"}}, view));
    EXPECT_LT(tested({{"slices", "128"}}, view), tested({{"slices", "8"}}, view));
    for (const char* division : {"view_uniform", "screen_uniform"})
        EXPECT_LT(tested({{"division", division}, {"slices", "256"}}, view),
                  tested({{"division", division}, {"slices", "4"}}, view))
            << division;
}

TEST_F(HybridLightingTest, links_hold_what_contiguous_lists_hold) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* cells : {"all", "occupied"}) {
        const auto contiguous = prepared({{"cells", cells}}, view);
        const auto linked = prepared({{"cells", cells}, {"lists", "linked"}}, view);
        EXPECT_EQ(linked->stats().references, contiguous->stats().references);
        const std::vector<PixelRecord> a = contiguous->record(view.frame()), b = linked->record(view.frame());
        EXPECT_TRUE(std::ranges::equal(a, b, {}, &PixelRecord::tested, &PixelRecord::tested)) << cells;
    }
}

TEST_F(HybridLightingTest, the_rasteriser_finds_the_tiles_of_the_compute_shader) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* lists : {"contiguous", "linked"}) {
        for (const char* coverage : {"tile", "centre_ray"}) {
            OptionValues options{{"lists", lists}, {"coverage", coverage}, {"billboards", "compute"}};
            const auto computed = prepared(options, view);
            options.back().second = "raster";
            const auto drawn = prepared(options, view);
            EXPECT_EQ(drawn->stats().references, computed->stats().references) << lists << ", " << coverage;
            const std::vector<PixelRecord> a = computed->record(view.frame()), b = drawn->record(view.frame());
            EXPECT_TRUE(std::ranges::equal(a, b, {}, &PixelRecord::tested, &PixelRecord::tested)) << coverage;
        }
    }
}

TEST_F(HybridLightingTest, a_pool_of_links_that_is_too_small_is_filled_again) {
    View view = made_view(device(), 97, 60, 100);
    const std::unique_ptr<Technique> technique = prepared(kLinked, view);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    technique->prepare(view.frame());
    const std::uint64_t froxels = references({{"tiles", "30x17"}}, view) / 100;
    EXPECT_GT(froxels, 30 * 17 * 16u);
    EXPECT_EQ(technique->stats().references, 100 * froxels);
    EXPECT_TRUE(verified(*technique, view).exact());
    technique->rebuild(view.frame());
    EXPECT_EQ(technique->stats().references, 100 * froxels);
    EXPECT_TRUE(verified(*technique, view).exact());
}

TEST_F(HybridLightingTest, froxels_without_points_need_no_lists) {
    const View view = made_view(device(), 97, 60, 1500);
    EXPECT_LT(references({{"cells", "occupied"}}, view), references({}, view) / 4);
    EXPECT_EQ(tested({{"cells", "occupied"}}, view), tested({}, view));
}

TEST_F(HybridLightingTest, only_lists_of_all_froxels_serve_points_that_come_later) {
    for (const char* lists : {"contiguous", "linked"}) {
        for (const char* cells : {"all", "occupied"}) {
            View view = made_view(device(), 97, 60, 1500);
            for (Light& light : view.lights) light.sphere.range *= 2.0f;
            const auto technique = prepared({{"lists", lists}, {"cells", cells}}, view);
            bring_points_closer(view);
            const bool serves_all = std::string(cells) == "all";
            EXPECT_EQ(verified(*technique, view).exact(), serves_all) << lists << ", " << cells;
            EXPECT_EQ(technique->info().needs_depth, !serves_all);
            EXPECT_EQ(technique->info().serves_translucent && technique->info().serves_air, serves_all);
        }
    }
}

// The published form asks the ray through a tile's centre, and a rasteriser by itself asks whether the centre is
// covered.
TEST_F(HybridLightingTest, tile_centres_lose_lights) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* billboards : {"compute", "raster"}) {
        for (const char* coverage : {"tile", "centre_ray", "plain"}) {
            const auto technique = prepared({{"billboards", billboards}, {"coverage", coverage}}, view);
            const VerifyResult result = verified(*technique, view);
            EXPECT_EQ(result.exact(), technique->info().exact) << coverage;
            EXPECT_EQ(technique->info().exact, std::string(coverage) == "tile");
            EXPECT_EQ(result.missing_points, result.wrong_pixels) << "nothing is there that should not be";
        }
    }
}

TEST_F(HybridLightingTest, nothing_is_lost_at_the_ends_of_grids_and_lights) {
    View view = made_view(device(), 97, 60, 300);
    for (std::size_t i = 0; i < 100; ++i) view.lights[i * 3].sphere = view.lights[0].sphere;
    view.lights[1].sphere.range = 900.0f;
    view.lights[2].sphere.range = 1e18f;
    view.lights[4].sphere = {{1e12f, 0, 0}, 2e12f};
    const glm::vec3 eye = view.camera.position;
    view.lights[5].sphere = {{eye.x, eye.y, eye.z}, 3.0f};
    for (const char* billboards : {"compute", "raster"})
        // Of the last grid some tiles are empty.
        for (const char* tiles : {"1x1", "96x61", "130x7"})
            for (const char* slices : {"1", "2", "150"})
                expect_exact({{"tiles", tiles}, {"slices", slices}, {"billboards", billboards}}, view);
}

TEST_F(HybridLightingTest, a_frame_may_change_its_size_and_be_built_again) {
    const View small = made_view(device(), 40, 31, 300), large = made_view(device(), 97, 60, 700);
    for (const OptionValues& options : {OptionValues{}, kLinked, OptionValues{{"cells", "occupied"}}, kRaster}) {
        const std::unique_ptr<Technique> technique = make_technique(device(), "hybrid_lighting", options);
        for (const View* view : {&small, &large, &small}) {
            technique->prepare(view->frame());
            technique->rebuild(view->frame());
            EXPECT_EQ(technique->stats().build_ms.size(), 2u);
            EXPECT_TRUE(verified(*technique, *view).exact()) << ::testing::PrintToString(options);
        }
    }
}

// A wave of one lane touches what its pixel is said to read.
TEST_F(HybridLightingTest, waves_touch_what_pixels_read) {
    View view = made_view(device(), 1, 1, 500);
    view.positions = {{camera_basis(view.camera, 1, 1).forward * 20.0f, 20.0f}};
    view.points.positions().upload(view.positions);
    for (const OptionValues& options : {OptionValues{}, kLinked}) {
        const auto technique = prepared(options, view);
        const PixelRecord record = technique->record(view.frame()).front();
        const WaveSummary waves = technique->waves(view.frame());
        EXPECT_GT(record.tested, 0u);
        EXPECT_EQ(record.references, record.tested);
        EXPECT_EQ(record.nodes, 1u);
        EXPECT_EQ(waves.lanes_64.tested, record.tested);
        EXPECT_EQ(waves.lanes_64.nodes, record.nodes);
    }
}

TEST_F(HybridLightingTest, says_what_it_holds) {
    const View view = made_view(device(), 97, 60, 700);
    const OptionValues grid{{"tiles", "5x3"}, {"slices", "7"}};
    const TechniqueStats contiguous = prepared(grid, view)->stats();
    const std::uint64_t froxels = 5 * 3 * 7, grid_bytes = 20 + 4 * 8;
    EXPECT_GT(contiguous.references, 700u);
    EXPECT_EQ(contiguous.structure_bytes, grid_bytes + 8 * froxels + 4 * contiguous.references);
    const TechniqueStats linked = prepared({{"tiles", "5x3"}, {"slices", "7"}, {"lists", "linked"}}, view)->stats();
    EXPECT_EQ(linked.structure_bytes, grid_bytes + 4 * froxels + 8 * linked.references);
    // The first pool has room for more.
    const TechniqueStats one = prepared({{"tiles", "1x1"}, {"slices", "1"}, {"lists", "linked"}}, view)->stats();
    EXPECT_EQ(one.references, one.visible_lights);
    EXPECT_EQ(one.structure_bytes, 28 + 4 + 8 * one.references);
}

} // namespace manylights::lab
