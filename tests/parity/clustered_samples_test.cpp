// Clusters of samples: the same ones whichever way they are found, as many as there are cells with samples; lights in
// front of every sample where clusters have normals; hierarchies of every shape.

#include "lab/scene/error.h"
#include "lab/techniques/device/depth_slices.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <limits>
#include <set>

namespace manylights::lab {
namespace {

struct Result {
    std::vector<PixelRecord> records;
    TechniqueStats stats;
};

class ClusteredSamplesTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> make(const OptionValues& options) const {
        return make_technique(device(), "clustered_samples", options);
    }

    Result run(const View& view, const OptionValues& options) const {
        const std::unique_ptr<Technique> technique = make(options);
        technique->prepare(view.frame());
        std::vector<PixelRecord> records = technique->record(view.frame());
        return {std::move(records), technique->stats()};
    }

    void expect_exact(const View& view, const OptionValues& options, const std::string& what) const {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        EXPECT_TRUE(compare(truth, run(view, options).records, view.width).exact()) << what;
    }
};

// What is left of the structure's bytes: 4 of each pixel, 8 of each cluster, 4 of each reference.
std::uint64_t cluster_count(const View& view, const TechniqueStats& stats) {
    return (stats.structure_bytes - 4 * view.positions.size() - 4 * stats.references) / 8;
}

// Tiles of 32 pixels.
std::uint64_t cells_with_samples(const View& view) {
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    const float tile_slope = 2.0f * basis.tan_half_y * 32.0f / static_cast<float>(view.height);
    const SliceEdges edges = self_similar_slices(view.camera.near_plane, view.scene.view_extent, 1.0f + tile_slope);
    std::set<std::pair<std::size_t, std::ptrdiff_t>> cells;
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const float depth = view.positions[pixel].depth;
        const std::size_t tile = pixel / view.width / 32 * view.width + pixel % view.width / 32;
        const auto slice = std::upper_bound(edges.begin(), edges.end(), depth) - edges.begin();
        if (depth > 0.0f) cells.emplace(tile, slice);
    }
    return cells.size();
}

void make_sky(View& view) {
    for (PointPosition& point : view.positions) point = {glm::vec3(0.0f), 0.0f};
}

void upload(View& view) {
    view.points.positions().upload(view.positions);
    view.points.normals().upload(view.normals);
}

bool has_same_front(const PixelRecord& a, const PixelRecord& b) {
    return a.front == b.front && a.front_hash_a == b.front_hash_a && a.front_hash_b == b.front_hash_b;
}

void expect_same_front(const std::vector<PixelRecord>& truth, const std::vector<PixelRecord>& got,
                       const std::string& what) {
    ASSERT_EQ(truth.size(), got.size());
    for (std::size_t i = 0; i < got.size(); ++i)
        ASSERT_TRUE(has_same_front(truth[i], got[i])) << "pixel " << i << ", " << what;
}

TEST_F(ClusteredSamplesTest, are_as_many_as_there_are_cells_with_samples) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {33u, 32u}, {97u, 60u}}) {
        const View view = made_view(device(), width, height, 200);
        for (const char* unique : {"sort", "page_table", "bitmap"})
            EXPECT_EQ(cluster_count(view, run(view, {{"unique", unique}}).stats), cells_with_samples(view)) << unique;
    }
}

TEST_F(ClusteredSamplesTest, are_the_same_whichever_way_they_are_found) {
    const View view = made_view(device(), 97, 60, 700);
    for (const char* normals : {"off", "on"}) {
        for (const char* bounds : {"implicit", "explicit"}) {
            OptionValues options{{"normals", normals}, {"bounds", bounds}, {"unique", "sort"}};
            const Result sorted = run(view, options);
            for (const char* unique : {"page_table", "bitmap"}) {
                options.back().second = unique;
                const Result other = run(view, options);
                EXPECT_EQ(other.stats.references, sorted.stats.references) << normals << bounds << unique;
                EXPECT_EQ(other.stats.structure_bytes, sorted.stats.structure_bytes) << normals << bounds << unique;
                EXPECT_TRUE(compare(sorted.records, other.records, view.width).exact());
                for (std::size_t i = 0; i < other.records.size(); ++i)
                    ASSERT_EQ(other.records[i].tested, sorted.records[i].tested) << "pixel " << i << unique;
            }
        }
    }
}

TEST_F(ClusteredSamplesTest, have_shorter_lists_by_their_samples_and_the_same_from_every_hierarchy) {
    const View view = made_view(device(), 97, 60, 700);
    const auto references = [&](const OptionValues& options) { return run(view, options).stats.references; };
    EXPECT_LT(references({{"bounds", "explicit"}}), references({}));
    for (const char* fan_out : {"8", "16"}) EXPECT_EQ(references({{"fan_out", fan_out}}), references({})) << fan_out;
    const auto tested = [&](const char* fan_out) {
        return summarize(run(view, {{"query", "hierarchy"}, {"fan_out", fan_out}}).records).tested_mean;
    };
    EXPECT_LT(tested("32"), 350.0);
    EXPECT_LT(tested("8"), tested("32"));
}

TEST_F(ClusteredSamplesTest, share_a_cell_where_directions_are_alike) {
    View view = made_view(device(), 97, 60, 50);
    make_sky(view);
    const auto clusters = [&](const char* normals) {
        upload(view);
        return cluster_count(view, run(view, {{"normals", normals}}).stats);
    };
    EXPECT_EQ(clusters("off"), 0u);
    EXPECT_EQ(clusters("on"), 0u);
    view.positions[40].depth = view.positions[41].depth = 10.0f;
    view.normals[40].normal = {0.1f, 0.9f, 0.1f};
    view.normals[41].normal = {-0.1f, 0.8f, 0.1f};
    EXPECT_EQ(clusters("off"), 1u);
    EXPECT_EQ(clusters("on"), 1u);
    view.normals[41].normal = {-0.1f, -0.8f, 0.1f};
    EXPECT_EQ(clusters("off"), 1u);
    EXPECT_EQ(clusters("on"), 2u);
    view.positions[41].depth = 1000.0f;
    EXPECT_EQ(clusters("off"), 2u);
}

// What normals leave out is behind the sample that it is left out for, and gives it no light. The proof that knows of
// nothing but affecting lights says that they are missing.
TEST_F(ClusteredSamplesTest, with_normals_keep_every_light_in_front) {
    const View view = made_view(device(), 97, 60, 3000);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    for (const char* bounds : {"implicit", "explicit"}) {
        const double without = summarize(run(view, {{"bounds", bounds}}).records).tested_mean;
        for (const char* tile_size : {"16", "32"}) {
            const OptionValues options{{"normals", "on"}, {"bounds", bounds}, {"tile_size", tile_size}};
            const std::vector<PixelRecord> got = run(view, options).records;
            expect_same_front(truth, got, std::string(bounds) + tile_size);
            for (std::size_t i = 0; i < got.size(); ++i)
                ASSERT_TRUE(std::equal(truth[i].radiance, truth[i].radiance + 3, got[i].radiance)) << "pixel " << i;
            const VerifyResult result = compare(truth, got, view.width);
            EXPECT_GT(result.missing_points, 0u) << bounds << tile_size;
            EXPECT_EQ(result.missing_points, result.wrong_pixels);
            EXPECT_LT(summarize(got).tested_mean, without) << bounds << tile_size;
            EXPECT_FALSE(make(options)->info().exact);
        }
    }
}

// Lights so far from the small clusters that they reach, that little but the cones decides.
TEST_F(ClusteredSamplesTest, with_normals_keep_every_light_in_front_from_afar) {
    View view = made_view(device(), 65, 40, 200);
    for (Light& light : view.lights) light.sphere.range = 2000.0f;
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    for (const char* bounds : {"implicit", "explicit"}) {
        const std::vector<PixelRecord> got = run(view, {{"normals", "on"}, {"bounds", bounds}}).records;
        expect_same_front(truth, got, bounds);
        EXPECT_LT(summarize(got).tested_mean, 190.0);
    }
}

// Normals along the axes and the edges of patches, and such as have no direction.
TEST_F(ClusteredSamplesTest, with_normals_keep_every_light_in_front_of_awkward_normals) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const glm::vec3 awkward[] = {{0, 0, 0},    {0, -1, 0},  {1, 1, 1},  {-1, 1, 0},     {1, 1.0f / 3, -1.0f / 3},
                                 {-inf, 1, 1}, {nan, 1, 0}, {0, 0, -1}, {0, 1e-28f, 0}, {1, -1.0f / 3, 1},
                                 {0, 50, 0}};
    View view = made_view(device(), 97, 60, 2000);
    for (std::size_t i = 0; i < view.normals.size(); ++i) view.normals[i].normal = awkward[i % std::size(awkward)];
    upload(view);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    for (const char* bounds : {"implicit", "explicit"})
        expect_same_front(truth, run(view, {{"normals", "on"}, {"bounds", bounds}}).records, bounds);
}

// A light that counts as being everywhere has no centre that boxes or cones could be compared with.
TEST_F(ClusteredSamplesTest, serve_the_farthest_points) {
    View view = made_view(device(), 65, 40, 40);
    const CameraBasis basis = camera_basis(view.camera, view.width, view.height);
    for (const std::size_t pixel : {std::size_t{0}, view.positions.size() - 1}) {
        const float side = pixel == 0 ? -1.0f : 1.0f;
        const glm::vec3 ray = basis.forward + side * (basis.right * basis.tan_half_x - basis.up * basis.tan_half_y);
        view.positions[pixel] = {9.9e17f * ray, 9.9e17f};
        // The one faces the camera and a light before it, the other a light behind it and not the camera.
        view.normals[pixel].normal = side * ray;
        const glm::vec3 c = (pixel == 0 ? 6e17f : 1.4e18f) * ray;
        view.lights[pixel == 0 ? 3 : 4].sphere = {{c.x, c.y, c.z}, 1e18f};
    }
    upload(view);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    EXPECT_GT(truth.front().front, 0u);
    EXPECT_GT(truth.back().front, 0u);
    for (const char* bounds : {"implicit", "explicit"}) {
        EXPECT_TRUE(compare(truth, run(view, {{"bounds", bounds}}).records, view.width).exact()) << bounds;
        expect_same_front(truth, run(view, {{"bounds", bounds}, {"normals", "on"}}).records, bounds);
    }
    EXPECT_TRUE(compare(truth, run(view, {{"query", "hierarchy"}, {"fan_out", "8"}}).records, view.width).exact());
}

TEST_F(ClusteredSamplesTest, are_exact_for_hierarchies_of_every_shape) {
    for (const std::uint32_t count : {8u, 9u, 65u, 513u}) {
        const View view = made_view(device(), 33, 20, count);
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        for (const char* fan_out : {"8", "16", "32"})
            for (const char* query : {"clusters", "hierarchy"})
                EXPECT_TRUE(
                    compare(truth, run(view, {{"fan_out", fan_out}, {"query", query}}).records, view.width).exact())
                    << count << " lights, fan-out " << fan_out << ", " << query;
    }
}

TEST_F(ClusteredSamplesTest, are_exact_for_lights_at_one_point_and_for_one_that_is_everywhere) {
    View view = made_view(device(), 65, 40, 600);
    for (Light& light : view.lights)
        for (int axis = 0; axis < 3; ++axis) light.sphere.center[axis] = view.lights[0].sphere.center[axis];
    view.lights[599].sphere.range = 700.0f;
    View huge = made_view(device(), 65, 40, 600);
    huge.lights[77].sphere.range = 1e18f;
    huge.lights[78].sphere = {{1e15f, 0, 0}, 1.0f};
    for (const char* query : {"clusters", "hierarchy"}) {
        expect_exact(view, {{"query", query}, {"fan_out", "8"}}, "lights at one point");
        expect_exact(huge, {{"query", query}}, "a light that is everywhere");
    }
    expect_exact(huge, {{"bounds", "explicit"}}, "a light that is everywhere, explicit bounds");
    for (Light& light : huge.lights) light.sphere.range = 1e18f;
    const Result all = run(huge, {});
    EXPECT_EQ(all.stats.references, 600 * cluster_count(huge, all.stats));
    expect_exact(huge, {}, "lights that are everywhere");
}

TEST_F(ClusteredSamplesTest, are_the_same_when_they_are_built_again) {
    const View view = made_view(device(), 97, 60, 500);
    for (const OptionValues& options : {OptionValues{{"bounds", "explicit"}}, OptionValues{{"unique", "page_table"}},
                                        OptionValues{{"query", "hierarchy"}}}) {
        const std::unique_ptr<Technique> technique = make(options);
        technique->prepare(view.frame());
        const TechniqueStats first = technique->stats();
        const std::vector<PixelRecord> truth = technique->record(view.frame());
        technique->rebuild(view.frame());
        EXPECT_EQ(technique->stats().references, first.references);
        EXPECT_EQ(technique->stats().structure_bytes, first.structure_bytes);
        EXPECT_EQ(technique->stats().build_ms.size(), 2u);
        EXPECT_TRUE(compare(truth, technique->record(view.frame()), view.width).exact());
    }
}

TEST_F(ClusteredSamplesTest, say_what_they_serve) {
    EXPECT_TRUE(make({})->info().needs_depth);
    EXPECT_FALSE(make({})->info().serves_air);
    EXPECT_TRUE(make({})->info().exact);
    EXPECT_FALSE(make({{"query", "hierarchy"}})->info().needs_depth);
    EXPECT_TRUE(make({{"query", "hierarchy"}})->info().serves_air);
    EXPECT_TRUE(make({{"query", "hierarchy"}})->info().serves_translucent);
}

// 1,024 tiles, of some 81,000 slices each.
TEST_F(ClusteredSamplesTest, refuse_more_keys_than_there_is_room_for) {
    View view = made_view(device(), 1, 16384, 5);
    view.camera.near_plane = 1e-30f;
    view.scene.view_extent = 1e10f;
    for (const auto& [unique, rule] : {std::pair{"sort", "4194303 keys of a tile"},
                                       {"page_table", "4294967296 keys"},
                                       {"bitmap", "1073741824 keys"}}) {
        const std::unique_ptr<Technique> technique = make({{"unique", unique}, {"normals", "on"}, {"tile_size", "16"}});
        try {
            technique->prepare(view.frame());
            ADD_FAILURE() << unique << " does not refuse";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(rule), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace manylights::lab
