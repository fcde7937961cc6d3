// Depth mode of the technique depth_windows: what is left of windows is valid, hands every point what the whole
// structure hands it, and is little more than that.

#include "lab/renderer/renderer.h"
#include "lab/scene/scene.h"
#include "lab/techniques/verification.h"
#include "tests/parity/pruned_windows.h"
#include "tests/parity/techniques_fixture.h"

#include <functional>

namespace manylights::lab {

namespace {

void set_points(View& view, const std::function<float(std::size_t pixel)>& depth_of) {
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const float depth = depth_of(pixel);
        const float x = 2.0f * (static_cast<float>(pixel % view.width) + 0.5f) / static_cast<float>(view.width) - 1.0f;
        const float y = 1.0f - 2.0f * (static_cast<float>(pixel / view.width) + 0.5f) / static_cast<float>(view.height);
        const glm::vec3 ray = basis.forward + basis.right * (x * basis.tan_half_x) + basis.up * (y * basis.tan_half_y);
        view.positions[pixel] = {ray * depth, depth};
    }
    view.points.positions().upload(view.positions);
}

// A light at a place of the image, from 0 to 1 to the right and downwards.
Light light_at(const View& view, float across, float down, float depth, float range) {
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    const glm::vec3 ray = basis.forward + basis.right * ((2.0f * across - 1.0f) * basis.tan_half_x) +
                          basis.up * ((1.0f - 2.0f * down) * basis.tan_half_y);
    const glm::vec3 center = view.camera.position + ray * depth;
    Light light;
    light.sphere = {{center.x, center.y, center.z}, range};
    return light;
}

std::set<std::uint32_t> numbers(std::uint32_t first, std::uint32_t end) {
    std::set<std::uint32_t> result;
    for (std::uint32_t i = first; i < end; ++i) result.insert(i);
    return result;
}

class DepthWindows : public TechniquesTest {};

} // namespace

TEST_F(DepthWindows, hand_every_point_what_the_whole_structure_does) {
    std::map<std::string, int> kinds;
    for (const auto& [width, height] : {std::pair{1u, 1u}, {47u, 33u}, {97u, 60u}}) {
        for (const std::uint32_t count : {0u, 1u, 33u, 1500u, 6000u}) {
            const View view = made_view(device(), width, height, count);
            for (const std::uint32_t tile_size : {8u, 13u, 32u, 4096u}) {
                const Pruned pruned = prune(device(), view.frame(), tile_size);
                const std::string what = std::to_string(width) + " pixels wide, " + std::to_string(count) +
                                         " lights, tiles of " + std::to_string(tile_size);
                expect_all_handed(pruned, view.positions, what);
                expect_small_tables(pruned.left);
                for (const auto& [kind, tiles] : kinds_of_tiles(pruned.left)) kinds[kind] += tiles;
            }
        }
    }
    for (const char* kind : {"empty", "flat", "one class", "two classes"}) EXPECT_GT(kinds[kind], 0) << kind;
}

// More references in a tile than 16 bits count: all of them needed, or few.
TEST_F(DepthWindows, become_narrow_where_few_references_are_left) {
    View view = made_view(device(), 24, 24, 75000);
    const auto kind_of = [&](const char* what) {
        const Pruned pruned = prune(device(), view.frame(), 4096);
        expect_all_handed(pruned, view.positions, what);
        EXPECT_GT(pruned.whole_references(), 65536u);
        return kinds_of_tiles(pruned.left).begin()->first;
    };
    EXPECT_EQ(kind_of("all points"), "two classes, wide");
    std::vector<PointPosition> points = view.positions;
    set_points(view, [&](std::size_t pixel) { return pixel < 40 ? points[pixel].depth : 0.0f; });
    EXPECT_EQ(kind_of("some points"), "two classes");
}

TEST_F(DepthWindows, of_the_sky_are_empty) {
    View view = made_view(device(), 97, 60, 1500);
    set_points(view, [](std::size_t) { return 0.0f; });
    const Pruned pruned = prune(device(), view.frame(), 16);
    EXPECT_EQ(pruned.broken, "");
    EXPECT_GT(pruned.whole_references(), 1000u);
    EXPECT_EQ(pruned.references, 0u);
    EXPECT_EQ(kinds_of_tiles(pruned.left), (std::map<std::string, int>{{"empty", 7 * 4}}));
    EXPECT_EQ(pruned.left.cells.size(), 2u * 7 * 4) << "no entries";
}

// One tile with two layers of points, and lights at them and between them.
TEST_F(DepthWindows, lose_lights_between_layers_of_points) {
    View view = made_view(device(), 32, 32, 0);
    set_points(view, [](std::size_t pixel) { return pixel % 2 == 0 ? 10.0f : 100.0f; });
    for (std::uint32_t i = 0; i < 90; ++i) {
        const float place = 0.1f + 0.008f * static_cast<float>(i);
        view.lights.push_back(light_at(view, place, place, i < 30 ? 10.0f : i < 60 ? 100.0f : 50.0f, 1.0f));
    }
    const Pruned pruned = prune(device(), view.frame(), 32);
    expect_all_handed(pruned, view.positions, "two layers");
    EXPECT_EQ(pruned.whole_references(), 90u);
    EXPECT_EQ(lights_left(pruned), numbers(0, 60));
}

// The near layer is on the left and the far one on the right: what is at a layer's depth on the other's side goes.
TEST_F(DepthWindows, lose_lights_beside_the_points_of_their_depth) {
    View view = made_view(device(), 32, 32, 0);
    set_points(view, [](std::size_t pixel) { return pixel % 32 < 16 ? 10.0f : 100.0f; });
    for (std::uint32_t i = 0; i < 40; ++i) {
        const float down = 0.1f + 0.02f * static_cast<float>(i);
        view.lights.push_back(light_at(view, i % 2 == 0 ? 0.2f : 0.8f, down, i < 20 ? 10.0f : 100.0f, 0.5f));
    }
    const Pruned pruned = prune(device(), view.frame(), 32);
    expect_all_handed(pruned, view.positions, "left and right");
    EXPECT_EQ(pruned.whole_references(), 40u);
    std::set<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 40; ++i)
        if ((i < 20) == (i % 2 == 0)) expected.insert(i);
    EXPECT_EQ(lights_left(pruned), expected);
}

// Where one class is left it takes the place of both, in its own units.
TEST_F(DepthWindows, lose_a_class_without_references) {
    for (const bool keeps_small : {true, false}) {
        View view = made_view(device(), 32, 32, 0);
        for (std::uint32_t i = 0; i < 400; ++i) {
            const auto step = static_cast<float>(i);
            const bool is_small = i % 2 == 0;
            const float depth = is_small == keeps_small ? 20.0f + 0.05f * step : 150.0f + 0.1f * step;
            view.lights.push_back(light_at(view, 0.5f, 0.5f, depth, is_small ? 0.3f : 8.0f));
        }
        set_points(view, [](std::size_t pixel) { return 18.0f + static_cast<float>(pixel % 23); });
        const Pruned pruned = prune(device(), view.frame(), 32);
        const Kept kept = expect_all_handed(pruned, view.positions, keeps_small ? "small lights" : "large lights");
        EXPECT_EQ(kinds_of_tiles(pruned.whole), (std::map<std::string, int>{{"two classes", 1}}));
        EXPECT_EQ(kinds_of_tiles(pruned.left), (std::map<std::string, int>{{"one class", 1}}));
        EXPECT_GT(kept.handed, 50u);
        for (const std::uint32_t light : lights_left(pruned)) EXPECT_EQ(light % 2 == 0, keeps_small);
    }
}

TEST_F(DepthWindows, of_scenes_keep_hardly_more_than_points_need) {
    const std::pair<const char*, const char*> scenes[] = {
        {"canyon", "volume"}, {"citadel", "surface"}, {"bars", "volume"}, {"cornell", "groups"}};
    for (const auto& [name, distribution] : scenes) {
        const Scene scene = load_scene(name, Detail::low);
        LightOptions options;
        options.count = 20000;
        options.distribution = distribution;
        for (const Camera& camera : {scene.cameras.front(), scene.cameras.back()}) {
            const PointBuffer points = Renderer(device(), scene).render_points(camera, 160, 90);
            const LightSet set = make_lights(scene, camera, options);
            const Frame frame{scene, camera, 160, 90, set.lights, points};
            const Pruned pruned = prune(device(), frame, 8);
            const Kept kept = expect_all_handed(pruned, points.download_positions(), name);
            expect_small_tables(pruned.left);
            const double left = static_cast<double>(pruned.references);
            EXPECT_LT(left, 1.1 * static_cast<double>(kept.needed)) << name;
            EXPECT_LT(static_cast<double>(kept.handed), 1.1 * static_cast<double>(kept.handed_by_whole)) << name;
            if (name == std::string("cornell")) continue; // a box without depth: its points need most lights
            EXPECT_LT(left, 0.4 * static_cast<double>(pruned.whole_references())) << name;
            EXPECT_LT(pruned.left.cells.size(), pruned.whole.cells.size()) << name;
        }
    }
}

TEST_F(DepthWindows, are_exact_in_every_scene) {
    LightOptions options;
    options.count = 3000;
    for (const SceneInfo& info : builtin_scenes()) {
        const Scene scene = load_scene(info.name, Detail::low);
        const Camera& camera = scene.cameras.back();
        const PointBuffer points = Renderer(device(), scene).render_points(camera, 101, 57);
        for (const char* distribution : {"volume", "surface", "view"}) {
            options.distribution = distribution;
            const LightSet set = make_lights(scene, camera, options);
            const Frame frame{scene, camera, 101, 57, set.lights, points};
            const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, frame);
            for (const char* tile_size : {"8", "27", "64", "4096"}) {
                const Variant variant{"", "depth_windows", {{"depth", "on"}, {"tile_size", tile_size}}};
                EXPECT_TRUE(compare(truth, records_of(device(), variant, frame), 101).exact())
                    << info.name << ", " << distribution << ", tiles of " << tile_size;
            }
        }
    }
}

TEST_F(DepthWindows, are_reported_as_they_are_left) {
    const View view = made_view(device(), 97, 60, 1500);
    const auto technique_with = [&](const char* depth) {
        std::unique_ptr<Technique> technique = make_technique(device(), "depth_windows", {{"depth", depth}});
        technique->prepare(view.frame());
        technique->rebuild(view.frame());
        return technique;
    };
    const Pruned pruned = prune(device(), view.frame(), 32);
    const std::unique_ptr<Technique> on = technique_with("on"), off = technique_with("off");
    EXPECT_EQ(on->stats().references, pruned.references);
    EXPECT_EQ(on->stats().structure_bytes,
              sizeof(MlView) + sizeof(MlCell) * pruned.left.cells.size() + 8 * pruned.references);
    EXPECT_LT(on->stats().references, off->stats().references);
    EXPECT_LT(on->stats().structure_bytes, off->stats().structure_bytes);
    EXPECT_EQ(on->stats().build_ms.size(), 2u);
    EXPECT_EQ(on->stats().stages.size(), off->stats().stages.size() + 1);
    EXPECT_EQ(on->stats().stages.back().name, "depth");
    EXPECT_EQ(on->stats().stages.back().ms.size(), 2u);
    EXPECT_TRUE(on->info().needs_depth);
    EXPECT_FALSE(on->info().serves_translucent || on->info().serves_air);
    EXPECT_FALSE(off->info().needs_depth);
}

// The same points and lights again, behind others: in the same buffers or in others.
TEST_F(DepthWindows, are_the_same_bytes_in_every_build) {
    const View small = made_view(device(), 47, 33, 1500), few = made_view(device(), 97, 60, 40);
    const View many = made_view(device(), 97, 60, 1500);
    DepthPruning pruning(device());
    const auto words_of = [](const Pruned& pruned) {
        std::vector<std::uint32_t> words = pruned.left.references;
        for (const MlCell& cell : pruned.left.cells) words.insert(words.end(), {cell.first, cell.count});
        return words;
    };
    for (const View* view : {&few, &many, &many, &small, &few, &many}) {
        const Pruned again = prune(pruning, device(), view->frame(), 16);
        EXPECT_EQ(again.broken, "");
        EXPECT_EQ(words_of(again), words_of(prune(device(), view->frame(), 16)));
        EXPECT_GE(pruning.milliseconds(), 0.0);
    }
}

} // namespace manylights::lab
