// No light is missing and none comes twice, whatever is switched on.

#include "tests/unit/paper/cases.h"
#include "tests/unit/paper/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::paper {
namespace {

struct OptionsCase {
    const char* name;
    Options options;
};

std::vector<OptionsCase> options_cases() {
    return {
        {"clustered", {.structure = Structure::clustered}},
        {"clustered, listing 4 as printed",
         {.structure = Structure::clustered, .slice_formula = SliceFormula::listing4_as_printed}},
        {"clustered, 128 slices", {.structure = Structure::clustered, .tile_px = 8, .slice_count = 128}},
        {"clustered, tight", {.structure = Structure::clustered, .tile_px = 32, .cell_test = CellTest::tight}},
        {"clustered, 128 slices, tight",
         {.structure = Structure::clustered, .tile_px = 8, .slice_count = 128, .cell_test = CellTest::tight}},
        {"tree", {.structure = Structure::tree}},
        {"tree, tight", {.structure = Structure::tree, .tile_px = 16, .cell_test = CellTest::tight}},
        {"tree, leaf 1", {.structure = Structure::tree, .leaf_size = 1}},
        {"tree, leaf 16, near key", {.structure = Structure::tree, .leaf_size = 16, .sort_key = SortKey::near_depth}},
        {"tree, cells sorted", {.structure = Structure::tree, .sort_scope = SortScope::each_cell}},
        {"tree, top-down", {.structure = Structure::tree, .tree_build = TreeBuild::top_down}},
        {"tree, entry per slice", {.structure = Structure::tree, .tree_entry = TreeEntry::per_slice}},
        {"tree, all three, 128 slices",
         {.structure = Structure::tree,
          .tile_px = 16,
          .slice_count = 128,
          .leaf_size = 1,
          .sort_key = SortKey::near_depth,
          .sort_scope = SortScope::each_cell,
          .tree_build = TreeBuild::top_down,
          .tree_entry = TreeEntry::per_slice}},
        {"hybrid", {}},
        {"hybrid, cells sorted, top-down",
         {.heuristic = Heuristic::expected_cost,
          .sort_scope = SortScope::each_cell,
          .tree_build = TreeBuild::top_down}},
        {"hybrid, listing 4 as printed", {.slice_formula = SliceFormula::listing4_as_printed}},
        {"hybrid, tight", {.tile_px = 16, .slice_count = 64, .cell_test = CellTest::tight}},
        {"hybrid, diameter", {.heuristic = Heuristic::diameter_extent}},
        {"hybrid, whole extent", {.heuristic = Heuristic::clipped_extent}},
        {"hybrid, expected cost", {.heuristic = Heuristic::expected_cost}},
        {"hybrid, always tree", {.leaf_size = 2, .heuristic = Heuristic::always_tree}},
        {"hybrid, always list, bounds of lights",
         {.heuristic = Heuristic::always_list, .list_bounds = ListBounds::of_lights}},
        {"hybrid, near key, one slice", {.slice_count = 1, .sort_key = SortKey::near_depth}},
        {"hybrid, tile 100, other slices", {.tile_px = 100, .slice_count = 40, .slice_near = 0.5f, .slice_far = 90}}};
}

// Returns how many (light, point) pairs were compared.
std::size_t expect_complete(Reader& reader, std::uint32_t view, const CameraCase& camera,
                            const std::vector<ManylightsSphere>& lights, const std::vector<PointCase>& points) {
    std::size_t pairs = 0;
    for (const PointCase& point : points) {
        std::vector<std::uint32_t> answer = reader.ask(view, point.position, point.depth).lights;
        std::sort(answer.begin(), answer.end());
        EXPECT_EQ(std::adjacent_find(answer.begin(), answer.end()), answer.end()) << "a light came twice";
        const auto affecting = affecting_lights(camera, lights, point.point);
        EXPECT_TRUE(std::includes(answer.begin(), answer.end(), affecting.begin(), affecting.end()))
            << "a light is missing at depth " << point.depth << ", pixel " << point.position.x << ' '
            << point.position.y;
        pairs += affecting.size();
        if (::testing::Test::HasFailure()) break;
    }
    return pairs;
}

TEST(Exactness, EverySwitchUnderEveryCamera) {
    const auto lights = random_lights(1234, 1);
    PaperPipeline pipeline;
    std::size_t pairs = 0;
    for (const CameraCase& camera : camera_cases()) {
        const ManylightsView view = make_view(camera);
        auto moved = lights;
        for (ManylightsSphere& light : moved) light.center[0] += camera.position[0] - 3.0f;
        const auto points = points_in_lights(camera, moved, 700, 2);
        for (const OptionsCase& options : options_cases()) {
            SCOPED_TRACE(std::string(camera.name) + ", " + options.name);
            Reader reader(pipeline.build({&view, 1}, lights_of(moved), options.options));
            pairs += expect_complete(reader, 0, camera, moved, points);
            ASSERT_FALSE(HasFailure());
        }
    }
    EXPECT_GT(pairs, 100000u);
}

TEST(Exactness, EveryCount) {
    const CameraCase camera{};
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline;
    for (std::uint32_t count : {65537u, 0u, 1u, 31u, 32u, 33u, 1234u}) {
        const auto lights = random_lights(count, 3);
        const auto points = points_in_lights(camera, lights, count > 10000 ? 200 : 1000, 4);
        for (Structure structure : {Structure::clustered, Structure::tree, Structure::hybrid}) {
            SCOPED_TRACE(std::to_string(count) + " lights, structure " + std::to_string(int(structure)));
            const Buffers& frame = pipeline.build({&view, 1}, lights_of(lights), {.structure = structure});
            Reader reader(frame);
            expect_complete(reader, 0, camera, lights, points);
            EXPECT_TRUE(count > 0 || frame.references.empty());
            EXPECT_TRUE(count < 1000 || !frame.references.empty());
        }
    }
}

// Spheres that contain the camera, cross the near plane or the camera plane, or have their silhouette at the horizon.
TEST(Exactness, AroundTheNearPlane) {
    for (double near_depth : {0.1, 1.0}) {
        CameraCase camera;
        camera.near_depth = near_depth;
        Random random(5);
        std::vector<ManylightsSphere> lights(800);
        for (ManylightsSphere& light : lights) {
            const auto direction = random.direction();
            const double distance = random.between(0.0, 6.0);
            for (int i = 0; i < 3; ++i) light.center[i] = float(camera.position[i] + distance * direction[i]);
            light.range = float(random.unit() < 0.2 ? random.between(50, 5000) : random.between(0.01, 5));
        }
        const ManylightsView view = make_view(camera);
        PaperPipeline pipeline;
        for (CellTest cell_test : {CellTest::box, CellTest::tight}) {
            Reader reader(pipeline.build({&view, 1}, lights_of(lights), {.tile_px = 16, .cell_test = cell_test}));
            EXPECT_GT(expect_complete(reader, 0, camera, lights, points_in_lights(camera, lights, 3000, 6)), 3000u);
        }
    }
}

// Silhouettes and depth ends on the edges of tiles and slices: a light whose tangent falls on a tile's edge.
TEST(Exactness, AtTileEdges) {
    CameraCase camera{.yaw = 0.0, .pitch = 0.0, .near_depth = 0.1, .width = 480, .height = 480};
    Random random(7);
    std::vector<ManylightsSphere> lights;
    std::vector<PointCase> points;
    constexpr double kCot = 1.7320508075688772;
    for (int i = 0; i < 4000; ++i) {
        const double edge = 48.0 * random.below(11); // pixels
        const double slope = (2.0 * edge / 480.0 - 1.0) / kCot, length = std::sqrt(1.0 + slope * slope);
        const double depth = random.between(0.5, 400.0), radius = random.between(0.01, 3.0), side = i % 2 ? 1.0 : -1.0;
        const double offset = side * radius * (1.0 - 2e-7 * random.unit()); // of the centre, across the edge's plane
        const double x = slope * depth + offset / length, z = depth - slope * offset / length;
        const float center[3] = {float(camera.position[0] + x), camera.position[1], float(camera.position[2] - z)};
        lights.push_back({{center[0], center[1], center[2]}, float(radius)});
        const MlFloat3 point{float(slope * depth), 0.0f, float(-depth)};
        for (double pixel : {edge - 0.5, edge + 0.5})
            if (pixel > 0.0 && pixel < 480.0) points.push_back({{float(pixel), 240.5f}, float(depth), point});
    }
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline;
    for (CellTest cell_test : {CellTest::box, CellTest::tight}) {
        Reader reader(
            pipeline.build({&view, 1}, lights_of(lights), {.structure = Structure::clustered, .cell_test = cell_test}));
        // Points a rounding error off their pixel's border are still within the promise's reach of both pixels, or not
        // by less than the widening.
        EXPECT_GT(expect_complete(reader, 0, camera, lights, points), 1000u);
    }
}

// Where a column's edge, a row's edge and a slice's edge meet: spheres on all sides of such a corner that only just
// hold it, asked for in the eight cells around it.
TEST(Exactness, AtCellCorners) {
    CameraCase camera{.yaw = 0.0, .pitch = 0.0, .width = 480, .height = 480};
    for (float& coordinate : camera.position) coordinate = 0.0f;
    const Options options{
        .structure = Structure::clustered, .tile_px = 16, .slice_count = 64, .cell_test = CellTest::tight};
    SliceTable slices;
    slices.update(options, options.slice_count);
    constexpr double kCot = 1.7320508075688772;
    Random random(17);
    std::vector<ManylightsSphere> lights;
    std::vector<PointCase> points;
    for (int i = 0; i < 4000; ++i) {
        const double x = 16.0 * (1 + random.below(29)), y = 16.0 * (1 + random.below(29)); // pixels
        const float depth = slices.edges()[1 + random.below(63)];
        const MlFloat3 point{float((2.0 * x / 480.0 - 1.0) / kCot * depth),
                             float((1.0 - 2.0 * y / 480.0) / kCot * depth), -depth};
        const double radius = random.between(0.01, 3.0), distance = radius * (1.0 - random.between(0.0, 1e-5));
        const auto direction = random.direction();
        lights.push_back({{float(point.x + distance * direction[0]), float(point.y + distance * direction[1]),
                           float(point.z + distance * direction[2])},
                          float(radius)});
        for (double side_x : {-0.5, 0.5})
            for (double side_y : {-0.5, 0.5})
                for (double shift : {-0.9, 0.0, 0.9})
                    points.push_back(
                        {{float(x + side_x), float(y + side_y)}, float(depth * (1.0 + shift * 0x1p-20)), point});
    }
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline;
    Reader reader(pipeline.build({&view, 1}, lights_of(lights), options));
    EXPECT_GT(expect_complete(reader, 0, camera, lights, points), 20000u);
}

// The nearest and the farthest points of lights, asked for at the ends of the depths that the promise allows. Trees of
// one light per leaf, whose bounds have nothing to spare.
TEST(Exactness, AtDepthEnds) {
    for (const CameraCase& camera : camera_cases()) {
        SCOPED_TRACE(camera.name);
        Random random(13);
        std::vector<ManylightsSphere> lights;
        std::vector<PointCase> points;
        const MlFloat3 ahead = ahead_of(camera);
        const float forward[3] = {ahead.x, ahead.y, ahead.z};
        while (lights.size() < 3000) {
            const double depth = random.between(1.0, 300.0), range = random.between(0.01, 3.0);
            ManylightsSphere light{{}, float(range)};
            for (int i = 0; i < 3; ++i) light.center[i] = float(camera.position[i] + depth * forward[i]);
            const MlFloat3 center = relative_to(camera, light.center);
            const double pole = (random.unit() < 0.5 ? -1.0 : 1.0) * range * (1.0 - random.between(0.0, 1e-6));
            const MlFloat3 point{float(center.x + pole * ahead.x), float(center.y + pole * ahead.y),
                                 float(center.z + pole * ahead.z)};
            lights.push_back(light);
            const ImagePoint image = project(camera, point);
            if (!(image.x > 0 && image.x < camera.width && image.y > 0 && image.y < camera.height)) continue;
            const double shift = (pole < 0 ? -0.9 : 0.9) * 0x1p-20;
            points.push_back({{std::floor(float(image.x)) + 0.5f, std::floor(float(image.y)) + 0.5f},
                              float(image.depth * (1.0 + shift)),
                              point});
        }
        const ManylightsView view = make_view(camera);
        PaperPipeline pipeline;
        Reader reader(pipeline.build({&view, 1}, lights_of(lights), {.structure = Structure::tree, .leaf_size = 1}));
        const std::size_t pairs = expect_complete(reader, 0, camera, lights, points);
        EXPECT_TRUE(pairs > 1000u || camera.offset_x != 0.0);
    }
}

TEST(Exactness, SeveralViewsInOneBuild) {
    const auto lights = random_lights(3000, 8);
    std::vector<CameraCase> cameras;
    for (const CameraCase& camera : camera_cases())
        if (camera.position[0] < 1e4f) cameras.push_back(camera);
    std::vector<ManylightsView> views;
    for (const CameraCase& camera : cameras) views.push_back(make_view(camera));
    PaperPipeline pipeline;
    for (const OptionsCase& options : options_cases()) {
        SCOPED_TRACE(options.name);
        const Buffers& frame = pipeline.build(views, lights_of(lights), options.options);
        ASSERT_EQ(frame.views.size(), views.size());
        Reader reader(frame);
        for (std::uint32_t view = 0; view < views.size(); ++view)
            expect_complete(reader, view, cameras[view], lights, points_in_lights(cameras[view], lights, 50, 9));
    }
}

TEST(Exactness, BadLightsAreCountedAndHarmNoOther) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const auto good = random_lights(500, 10);
    auto mixed = good;
    for (int axis = 0; axis < 3; ++axis) {
        for (float bad : {kNan, kInfinity, -kInfinity}) {
            ManylightsSphere light = good[0];
            light.center[axis] = bad;
            mixed.push_back(light);
        }
    }
    for (float bad : {kNan, -1.0f, -kInfinity}) mixed.push_back({{0, 20, 0}, bad});
    mixed.push_back({{0, 20, 0}, 0.0f}); // affects nothing, and is not bad
    const CameraCase camera{};
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline, other;
    const Buffers& with = pipeline.build({&view, 1}, lights_of(mixed), {});
    const Buffers& without = other.build({&view, 1}, lights_of(good), {});
    EXPECT_EQ(with.ignored_lights, 12u);
    EXPECT_EQ(without.ignored_lights, 0u);
    EXPECT_TRUE(std::equal(with.references.begin(), with.references.end(), without.references.begin(),
                           without.references.end()));
}

TEST(Exactness, HugeLightsReachEveryCell) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<ManylightsSphere> lights{{{0, 0, 0}, 1e6f},
                                               {{0, 0, 0}, 1e18f},
                                               {{5, 0, 0}, kInfinity},
                                               {{1e18f, 0, 0}, 2e18f},
                                               {{3e38f, -3e38f, 3e38f}, 1e18f}};
    const CameraCase camera{};
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline;
    for (const Options& options : {Options{.structure = Structure::clustered}, Options{.structure = Structure::tree},
                                   Options{}, Options{.cell_test = CellTest::tight}}) {
        Reader reader(pipeline.build({&view, 1}, lights_of(lights), options));
        for (float depth : {0.1f, 5.0f, 400.0f, 9e5f})
            for (float x : {0.5f, 300.5f, 639.5f})
                EXPECT_GE(reader.ask(0, {x, 100.5f}, depth).lights.size(), 4u) << depth << ' ' << x;
    }
}

TEST(Exactness, MotionMarginWidensEveryRange) {
    const CameraCase camera{};
    const ManylightsView view = make_view(camera);
    const auto lights = random_lights(500, 11);
    auto grown = lights;
    for (ManylightsSphere& light : grown) light.range += 1.9f;
    ManylightsLights input = lights_of(lights);
    input.motion_margin = 2.0f;
    PaperPipeline pipeline;
    Reader reader(pipeline.build({&view, 1}, input, {}));
    expect_complete(reader, 0, camera, grown, points_in_lights(camera, grown, 1000, 12));
}

} // namespace
} // namespace manylights::paper
