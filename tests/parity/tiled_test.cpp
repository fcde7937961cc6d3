// Tiles and cells of their depths: what is special to the techniques tiled and culling_2_5d.

#include "lab/techniques/device/tile_depths.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace manylights::lab {
namespace {

class TiledTest : public TechniquesTest {
  protected:
    std::uint64_t references_of(const View& view, const char* technique, const OptionValues& options) {
        const std::unique_ptr<Technique> made = make_technique(device(), technique, options);
        made->prepare(view.frame());
        return made->stats().references;
    }

    double tested_by(const View& view, const char* technique, const OptionValues& options) {
        return summarize(records_of(device(), {"", technique, options}, view.frame())).tested_mean;
    }

    void expect_exact(const View& view, const std::string& what) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        if (made_.empty())
            for (const Variant& variant : kVariants)
                made_.push_back(make_technique(device(), variant.technique, variant.options));
        for (std::size_t i = 0; i < made_.size(); ++i) {
            made_[i]->prepare(view.frame());
            const VerifyResult result = compare(truth, made_[i]->record(view.frame()), view.width);
            EXPECT_TRUE(result.exact()) << what << ", " << kVariants[i].label << ": " << result.wrong_pixels
                                        << " pixels";
        }
    }

    const std::vector<Variant> kVariants{{"tiled", "tiled", {}},
                                         {"planes", "tiled", {{"test", "planes"}}},
                                         {"rectangle", "tiled", {{"test", "rectangle"}, {"depth", "max"}}},
                                         {"no depths", "tiled", {{"depth", "none"}, {"tile_size", "64"}}},
                                         {"a", "culling_2_5d", {{"interval", "sphere"}, {"cells", "64"}}},
                                         {"b", "culling_2_5d", {{"variant", "b"}}},
                                         {"b of 64", "culling_2_5d", {{"variant", "b"}, {"cells", "64"}}},
                                         {"c", "culling_2_5d", {{"variant", "c"}, {"cells", "64"}}},
                                         {"counted", "tiled", {{"tiles", "30x17"}}},
                                         {"counted, no depths", "tiled", {{"tiles", "7x130"}, {"depth", "none"}}},
                                         // A light of the whole image has more tiles than one invocation goes over.
                                         {"small tiles", "tiled", {{"tile_size", "8"}}},
                                         {"small tiles of a", "culling_2_5d", {{"tile_size", "8"}}}};

  private:
    std::vector<std::unique_ptr<Technique>> made_; ///< once per test: pipelines take longer than frames
};

glm::vec3 ray_at(const View& view, float across, float down) {
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    return basis.forward + basis.right * ((2.0f * across - 1.0f) * basis.tan_half_x) +
           basis.up * ((1.0f - 2.0f * down) * basis.tan_half_y);
}

void set_points(View& view, const std::function<float(std::size_t pixel)>& depth_of) {
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const float depth = depth_of(pixel);
        const float across = (static_cast<float>(pixel % view.width) + 0.5f) / static_cast<float>(view.width);
        const float down = (static_cast<float>(pixel / view.width) + 0.5f) / static_cast<float>(view.height);
        view.positions[pixel] = {ray_at(view, across, down) * depth, depth};
    }
    view.points.positions().upload(view.positions);
}

Light light_at(const View& view, float across, float down, float depth, float range) {
    const glm::vec3 center = view.camera.position + ray_at(view, across, down) * depth;
    return {{{center.x, center.y, center.z}, range}, {1, 1, 1}};
}

// Two layers of points, 30 lights at each of them and 30 between.
View layers(gpu::Device& device) {
    View view = made_view(device, 32, 32, 0);
    set_points(view, [](std::size_t pixel) { return pixel % 2 == 0 ? 10.0f : 100.0f; });
    for (std::uint32_t i = 0; i < 90; ++i) {
        const float place = 0.1f + 0.008f * static_cast<float>(i);
        view.lights.push_back(light_at(view, place, place, i < 30 ? 10.0f : i < 60 ? 100.0f : 50.0f, 1.0f));
    }
    return view;
}

} // namespace

TEST_F(TiledTest, depths_of_tiles_are_those_of_their_points) {
    View view = made_view(device(), 97, 60, 0);
    set_points(view, [&](std::size_t pixel) { return pixel % 97 < 26 ? 0.0f : view.positions[pixel].depth; });
    TileDepths depths(device());
    const auto square = [](std::uint32_t size) { return tile_grid(97, 60, size); };
    const auto counted = [](std::uint32_t x, std::uint32_t y) { return tile_grid_of_counts(97, 60, x, y); };
    // Of the last one some tiles are empty.
    for (const TileGrid& grid :
         {square(8), square(13), square(64), counted(1, 1), counted(7, 11), counted(97, 60), counted(130, 17)}) {
        depths.find(view.points, grid);
        const std::vector<glm::vec2> found = depths.depths().download<glm::vec2>();
        const float infinity = std::numeric_limits<float>::infinity();
        std::vector<glm::vec2> expected(grid.tile_count(), glm::vec2(infinity, 0.0f));
        for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
            const float depth = view.positions[pixel].depth;
            if (depth == 0.0f) continue;
            const std::size_t x = pixel % 97 * grid.tiles_x / grid.span_x, y = pixel / 97 * grid.tiles_y / grid.span_y;
            glm::vec2& tile = expected[y * grid.tiles_x + x];
            tile = {std::min(tile.x, depth), std::max(tile.y, depth)};
        }
        EXPECT_EQ(found, expected) << grid.tiles_x << " x " << grid.tiles_y;
        EXPECT_EQ(std::ranges::count(expected, glm::vec2(infinity, 0.0f)) > 0, grid.tiles_x > 2);
    }
}

TEST_F(TiledTest, what_bounds_lights_more_leaves_fewer) {
    const View view = made_view(device(), 97, 60, 1500);
    const auto with = [&](const char* depth, const char* test) {
        return references_of(view, "tiled", {{"depth", depth}, {"test", test}, {"tile_size", "8"}});
    };
    EXPECT_LT(with("minmax", "narrowed"), with("max", "narrowed"));
    EXPECT_LT(with("max", "narrowed"), with("none", "narrowed"));
    EXPECT_LT(with("none", "narrowed"), with("none", "rectangle"));
    EXPECT_LE(with("none", "planes"), with("none", "rectangle"));
    EXPECT_LT(with("minmax", "narrowed"), with("minmax", "planes"));
    EXPECT_LT(references_of(view, "tiled", {{"tile_size", "64"}}), references_of(view, "tiled", {{"tile_size", "8"}}));
    EXPECT_LT(references_of(view, "culling_2_5d", {}), references_of(view, "culling_2_5d", {{"interval", "sphere"}}));
    EXPECT_LT(references_of(view, "culling_2_5d", {{"cells", "64"}}),
              references_of(view, "culling_2_5d", {{"cells", "8"}}));
}

TEST_F(TiledTest, tiles_of_a_number_are_those_of_a_size_where_these_divide_the_image) {
    const View view = made_view(device(), 96, 64, 900);
    const OptionValues counted{{"tiles", "6x4"}};
    EXPECT_EQ(references_of(view, "tiled", counted), references_of(view, "tiled", {}));
    EXPECT_EQ(tested_by(view, "tiled", counted), tested_by(view, "tiled", {}));
    EXPECT_NE(references_of(view, "tiled", {{"tiles", "5x4"}}), references_of(view, "tiled", {}));
}

TEST_F(TiledTest, cells_lose_lights_between_layers_of_points) {
    const View view = layers(device());
    const OptionValues one_tile{{"tile_size", "32"}};
    EXPECT_EQ(references_of(view, "tiled", one_tile), 90u);
    EXPECT_EQ(references_of(view, "culling_2_5d", one_tile), 60u);
    EXPECT_EQ(tested_by(view, "culling_2_5d", one_tile), 60.0);
    for (const char* cells : {"8", "64"})
        for (const char* variant : {"b", "c"})
            EXPECT_EQ(tested_by(view, "culling_2_5d", {{"tile_size", "32"}, {"variant", variant}, {"cells", cells}}),
                      30.0)
                << variant << " of " << cells;
}

// Masks are compared before lights are tested, and so counted; a list per cell has nothing to compare.
TEST_F(TiledTest, waves_of_masks_have_checks) {
    const View view = layers(device());
    for (const char* variant : {"a", "b", "c"}) {
        const auto technique = make_technique(device(), "culling_2_5d", {{"tile_size", "32"}, {"variant", variant}});
        technique->prepare(view.frame());
        const WaveSummary waves = technique->waves(view.frame());
        EXPECT_EQ(waves.lanes_64.waves, 16u);
        EXPECT_EQ(waves.lanes_64.tested, 16u * 60) << variant;
        EXPECT_EQ(waves.lanes_64.checks, *variant == 'b' ? 16u * 60 : 0u) << variant;
        EXPECT_EQ(waves.lanes_64.nodes, 16u * (*variant == 'a' ? 1 : *variant == 'b' ? 2 : 3)) << variant;
    }
}

TEST_F(TiledTest, nothing_is_lost_in_flat_tiles_and_at_their_ends) {
    View view = made_view(device(), 70, 41, 0);
    for (std::uint32_t i = 0; i < 300; ++i) {
        const float place = static_cast<float>(i) / 300.0f;
        view.lights.push_back(light_at(view, place, 1.0f - place, 10.0f + 0.1f * static_cast<float>(i % 9), 0.9f));
    }
    set_points(view, [](std::size_t) { return 10.0f; });
    expect_exact(view, "flat");
    const float next = std::nextafter(10.0f, 11.0f);
    set_points(view, [&](std::size_t pixel) { return pixel % 3 == 0 ? next : 10.0f; });
    expect_exact(view, "all but flat");
    set_points(view, [](std::size_t pixel) { return 10.0f + 0.01f * static_cast<float>(pixel % 101); });
    expect_exact(view, "slanted");
    set_points(view, [](std::size_t pixel) { return pixel == 777 ? 10.5f : 0.0f; });
    expect_exact(view, "one point");
    set_points(view, [](std::size_t) { return 0.0f; });
    expect_exact(view, "sky");
}

TEST_F(TiledTest, nothing_is_lost_among_huge_lights_and_lights_at_one_point) {
    View view = made_view(device(), 97, 60, 400);
    for (std::size_t i = 0; i < 100; ++i) view.lights[i * 4].sphere = view.lights[0].sphere;
    view.lights[1].sphere.range = 900.0f;
    view.lights[2].sphere.range = 1e18f;
    view.lights[3].sphere = {{1e12f, 0, 0}, 2e12f};
    expect_exact(view, "one point, and huge");
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    expect_exact(view, "everywhere");
}

// The structure without depths serves points that were not there when it was built; the proof notices where one with
// depths is asked for them.
TEST_F(TiledTest, lists_serve_what_their_infos_say) {
    View view = made_view(device(), 97, 60, 900);
    const std::vector<PointPosition> points = view.positions;
    const auto wrong_pixels = [&](const char* technique, const OptionValues& options, bool serves_all) {
        view.points.positions().upload(points);
        const std::unique_ptr<Technique> made = make_technique(device(), technique, options);
        made->prepare(view.frame());
        EXPECT_EQ(made->info().needs_depth, !serves_all);
        EXPECT_EQ(made->info().serves_translucent && made->info().serves_air, serves_all);
        set_points(view, [&](std::size_t pixel) { return points[points.size() - 1 - pixel].depth; });
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        return compare(truth, made->record(view.frame()), view.width).wrong_pixels;
    };
    for (const char* test : {"narrowed", "planes", "rectangle"})
        EXPECT_EQ(wrong_pixels("tiled", {{"depth", "none"}, {"test", test}}, true), 0u) << test;
    EXPECT_GT(wrong_pixels("tiled", {{"tile_size", "8"}}, false), 0u);
    EXPECT_GT(wrong_pixels("culling_2_5d", {{"tile_size", "8"}}, false), 0u);
}

TEST_F(TiledTest, a_frame_may_change_its_size_and_be_built_again) {
    const View small = made_view(device(), 40, 31, 300), large = made_view(device(), 97, 60, 700);
    for (const Variant& variant : kVariants) {
        const std::unique_ptr<Technique> technique = make_technique(device(), variant.technique, variant.options);
        for (const View* view : {&small, &large, &small}) {
            technique->prepare(view->frame());
            technique->rebuild(view->frame());
            EXPECT_EQ(technique->stats().build_ms.size(), 2u);
            const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view->frame());
            EXPECT_TRUE(compare(truth, technique->record(view->frame()), view->width).exact()) << variant.label;
        }
    }
}

} // namespace manylights::lab
