// The techniques against brute force, and brute force against the oracle: on the device, bit by bit.

#include "lab/renderer/renderer.h"
#include "lab/scene/scene.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "reference/oracle/light_hash.h"
#include "reference/oracle/light_set.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace manylights::lab {

namespace {

void expect_exact(const VerifyResult& result, const std::string& what) {
    EXPECT_EQ(result.wrong_pixels, 0u) << what << ": first wrong pixel " << result.first_x << ", " << result.first_y
                                       << " has " << result.first_got.affecting << " lights instead of "
                                       << result.first_truth.affecting;
}

std::string name_of(const ::testing::TestParamInfo<Variant>& info) { return info.param.label; }

struct ImageSize {
    std::uint32_t width, height;
};
// The last has tiles side by side and one below the other, cut by the image's edges.
constexpr ImageSize kSizes[] = {{1, 1}, {47, 33}, {48, 48}, {97, 60}};

// What brute force on the device should have written for a pixel, by the oracle.
PixelRecord oracle_record(const View& view, std::size_t pixel, const std::vector<oracle::RelativeLight>& lights) {
    PixelRecord record{};
    const PointPosition& point = view.positions[pixel];
    if (point.depth == 0.0f) return record;
    const oracle::LightSet set =
        oracle::affecting_lights({point.position.x, point.position.y, point.position.z}, lights);
    record.shaded = 1;
    record.affecting = static_cast<std::uint32_t>(set.indices.size());
    record.hash_a = set.hash_a;
    record.hash_b = set.hash_b;
    const glm::vec3 normal = view.normals[pixel].normal;
    for (const oracle::RelativeLight& light : lights) {
        if (!std::ranges::binary_search(set.indices, light.index)) continue;
        const float x = light.center.x - point.position.x;
        const float y = light.center.y - point.position.y;
        const float z = light.center.z - point.position.z;
        if (!(normal.x * x + normal.y * y + normal.z * z > 0.0f)) continue;
        record.front += 1;
        record.front_hash_a += light_hash_a(light.index);
        record.front_hash_b += light_hash_b(light.index);
    }
    return record;
}

std::vector<PixelRecord> oracle_records(const View& view) {
    const ManylightsLights lights = public_lights(view.frame());
    const float eye[3] = {view.camera.position.x, view.camera.position.y, view.camera.position.z};
    const std::vector<oracle::RelativeLight> relative = oracle::relative_lights(lights, eye);
    std::vector<PixelRecord> records;
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel)
        records.push_back(oracle_record(view, pixel, relative));
    return records;
}

// The oracle knows sets, no radiance and no work.
void expect_sets_of_oracle(const View& view, std::vector<PixelRecord> got) {
    for (PixelRecord& record : got) {
        std::ranges::fill(record.radiance, 0);
        record.tested = record.nodes = record.references = 0;
    }
    expect_exact(compare(oracle_records(view), got, view.width), "brute force against the oracle");
}

// One of each technique.
std::vector<Variant> first_variants() {
    std::vector<Variant> firsts;
    for (const Variant& variant : all_variants())
        if (std::ranges::none_of(firsts,
                                 [&](const Variant& v) { return std::string_view(v.technique) == variant.technique; }))
            firsts.push_back(variant);
    return firsts;
}

// Views, and what brute force finds in them.
class Views {
  public:
    void add(gpu::Device& device, std::unique_ptr<View> view, std::string name) {
        std::vector<PixelRecord> truth = records_of(device, kBruteForce, view->frame());
        entries_.push_back({std::move(view), std::move(name), std::move(truth)});
    }
    const std::vector<PixelRecord>& last_truth() const { return entries_.back().truth; }

    // In each by the same technique, one after the other.
    void expect_exact_by(gpu::Device& device, const Variant& variant) const {
        const std::unique_ptr<Technique> technique = make_technique(device, variant.technique, variant.options);
        for (const Entry& entry : entries_) {
            technique->prepare(entry.view->frame());
            const std::vector<PixelRecord> got = technique->record(entry.view->frame());
            expect_exact(compare(entry.truth, got, entry.view->width), std::string(variant.label) + ", " + entry.name);
            EXPECT_EQ(light_set_hash(entry.truth), light_set_hash(got));
        }
    }

  private:
    struct Entry {
        std::unique_ptr<View> view;
        std::string name;
        std::vector<PixelRecord> truth;
    };
    std::vector<Entry> entries_;
};

class StructureTest : public TechniquesTest, public ::testing::WithParamInterface<Variant> {};
INSTANTIATE_TEST_SUITE_P(Techniques, StructureTest, ::testing::ValuesIn(structure_variants()), name_of);

class VariantTest : public TechniquesTest, public ::testing::WithParamInterface<Variant> {};
INSTANTIATE_TEST_SUITE_P(Techniques, VariantTest, ::testing::ValuesIn(all_variants()), name_of);

} // namespace

TEST_F(TechniquesTest, brute_force_equals_the_oracle) {
    for (const ImageSize size : kSizes) {
        const View view = made_view(device(), size.width, size.height, 1234);
        expect_sets_of_oracle(view, records_of(device(), kBruteForce, view.frame()));
    }
}

// More pixels than one dispatch writes, so that the image comes in bands.
TEST_F(TechniquesTest, brute_force_equals_the_oracle_over_several_bands) {
    const View view = made_view(device(), 761, 700, 5);
    expect_sets_of_oracle(view, records_of(device(), kBruteForce, view.frame()));
}

TEST_F(TechniquesTest, brute_force_counts_every_light_as_tested) {
    const View view = made_view(device(), 48, 48, 300);
    const WorkSummary work = summarize(records_of(device(), kBruteForce, view.frame()));
    EXPECT_GT(work.affecting_mean, 1.0);
    EXPECT_EQ(work.tested_mean, 300.0);
    EXPECT_EQ(work.tested_max, 300u);
}

TEST_F(TechniquesTest, unusable_lights_affect_nothing_and_leave_the_others_alone) {
    View view = made_view(device(), 47, 33, 200);
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    view.lights[3].sphere.range = -50.0f;
    view.lights[7].sphere.range = nan;
    view.lights[40].sphere.center[0] = nan;
    view.lights[41].sphere.center[1] = inf;
    view.lights[42].sphere.center[2] = -inf;
    view.lights[90].sphere.range = inf; // stands for the largest range: it affects every point
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    expect_sets_of_oracle(view, truth);
    for (const Variant& variant : all_variants())
        expect_exact(compare(truth, records_of(device(), variant, view.frame()), view.width), variant.label);
}

// One of each technique for all views, so that frames of other sizes and counts come before each.
TEST_F(TechniquesTest, all_agree_with_brute_force_for_every_count_and_size) {
    Views views;
    for (const std::uint32_t count : {1234u, 0u, 33u, 1u, 32u, 31u})
        for (const ImageSize size : kSizes)
            views.add(device(), std::make_unique<View>(made_view(device(), size.width, size.height, count)),
                      std::to_string(count) + " lights");
    for (const Variant& variant : all_variants()) views.expect_exact_by(device(), variant);
}

// Brute force needs two submissions for so many, and a tile holds more than 16 bits count. All variants with
// MANYLIGHTS_FULL set.
TEST_F(TechniquesTest, all_agree_with_brute_force_for_65537_lights) {
    const View view = made_view(device(), 48, 48, 65537);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const WorkSummary work = summarize(truth);
    EXPECT_GT(work.affecting_mean, 1.0);
    EXPECT_EQ(work.tested_max, 65537u);
    for (const Variant& variant : std::getenv("MANYLIGHTS_FULL") != nullptr ? all_variants() : first_variants()) {
        const std::vector<PixelRecord> got = records_of(device(), variant, view.frame());
        expect_exact(compare(truth, got, view.width), variant.label);
        EXPECT_LT(summarize(got).tested_mean, work.tested_mean);
    }
}

TEST_F(TechniquesTest, all_agree_with_brute_force_in_built_in_scenes) {
    Views views;
    for (const char* name : {"cornell", "canyon"}) {
        for (const char* distribution : {"volume", "surface", "groups"}) {
            Scene scene = load_scene(name, Detail::low);
            const Camera camera = find_camera(scene, "");
            PointBuffer points = Renderer(device(), scene).render_points(camera, 96, 54);
            LightOptions options;
            options.count = 2000;
            options.distribution = distribution;
            std::vector<Light> lights = make_lights(scene, camera, options).lights;
            auto view = std::make_unique<View>(
                View{std::move(scene), camera, 96, 54, {}, {}, std::move(lights), std::move(points)});
            views.add(device(), std::move(view), std::string(name) + ", " + distribution);
            EXPECT_GT(summarize(views.last_truth()).affecting_mean, 0.0) << name << ", " << distribution;
        }
    }
    for (const Variant& variant : all_variants()) views.expect_exact_by(device(), variant);
}

TEST_P(VariantTest, shows_a_removed_light) {
    const View view = made_view(device(), 97, 60, 500);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const std::unique_ptr<Technique> technique = make_technique(device(), GetParam().technique, GetParam().options);
    technique->prepare(view.frame());
    ASSERT_TRUE(technique->remove_one_reference(view.frame()));
    const VerifyResult result = compare(truth, technique->record(view.frame()), view.width);
    EXPECT_FALSE(result.exact());
    EXPECT_GE(result.missing_points, 1u);
    EXPECT_EQ(result.missing_points, result.wrong_pixels);
    ASSERT_TRUE(result.has_first_wrong);
    EXPECT_EQ(result.first_got.affecting + 1, result.first_truth.affecting);

    const PointPosition& point = view.positions[std::size_t{result.first_y} * view.width + result.first_x];
    const std::vector<std::uint32_t> affecting = affecting_lights(make_light_stream(view.frame()), point.position);
    EXPECT_EQ(missing_lights(result.first_truth, result.first_got, affecting).size(), 1u);

    technique->prepare(view.frame());
    expect_exact(compare(truth, technique->record(view.frame()), view.width), "built again");
}

TEST_P(VariantTest, removes_no_reference_where_no_light_affects_a_point) {
    const View view = made_view(device(), 47, 33, 0);
    const std::unique_ptr<Technique> technique = make_technique(device(), GetParam().technique, GetParam().options);
    technique->prepare(view.frame());
    EXPECT_FALSE(technique->remove_one_reference(view.frame()));
}

TEST_P(VariantTest, shades_the_image_of_brute_force) {
    const View view = made_view(device(), 64, 40, 400);
    const std::unique_ptr<Technique> brute_force = make_technique(device(), "brute_force", {});
    const std::unique_ptr<Technique> technique = make_technique(device(), GetParam().technique, GetParam().options);
    brute_force->prepare(view.frame());
    technique->prepare(view.frame());
    const std::vector<float> truth = brute_force->shade(view.frame());
    const std::vector<float> got = technique->shade(view.frame());
    const std::vector<PixelRecord> records = technique->record(view.frame());
    ASSERT_EQ(truth.size(), got.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        ASSERT_TRUE(std::isfinite(got[i])) << "value " << i;
        ASSERT_NEAR(got[i], truth[i], 1e-5f * (1.0f + truth[i])) << "value " << i;
        const double recorded = std::ldexp(static_cast<double>(records[i / 3].radiance[i % 3]), -20);
        ASSERT_NEAR(got[i], recorded, 1e-3 * (1.0 + recorded)) << "value " << i;
        sum += got[i];
    }
    EXPECT_GT(sum, 0.0);
    EXPECT_EQ(technique->stats().shade_ms.size(), 1u);
    EXPECT_EQ(technique->stats().build_ms.size(), GetParam().label == std::string("exact") ? 0u : 1u);
}

TEST_P(StructureTest, reports_what_it_built) {
    const View view = made_view(device(), 97, 60, 500);
    const std::unique_ptr<Technique> technique = make_technique(device(), GetParam().technique, GetParam().options);
    technique->prepare(view.frame());
    const TechniqueStats& stats = technique->stats();
    EXPECT_GT(stats.visible_lights, 100u);
    EXPECT_LE(stats.visible_lights, 500u);
    EXPECT_GE(stats.references, stats.visible_lights);
    const std::uint64_t words = std::string(GetParam().technique).starts_with("depth_windows") ? 2 : 1;
    EXPECT_GT(stats.structure_bytes, 4 * words * stats.references);
}

// The switches of the paper change the work and never the answer.
TEST_F(TechniquesTest, every_switch_of_the_paper_is_exact) {
    const View view = made_view(device(), 97, 60, 1500);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const auto check = [&](const char* technique, OptionValues options) {
        options.emplace_back("producer", "paper");
        const std::string what = std::string(technique) + " " + options.front().first + "=" + options.front().second;
        expect_exact(compare(truth, records_of(device(), {"", technique, options}, view.frame()), view.width), what);
    };
    for (const char* heuristic : {"a", "b", "c", "d", "e", "lists"})
        check("hybrid_light_trees", {{"heuristic", heuristic}});
    for (const char* technique : {"clustered", "hybrid_light_trees"}) check(technique, {{"listing4", "printed"}});
    for (const char* technique : {"tiled_light_trees", "hybrid_light_trees"}) check(technique, {{"sort_key", "near"}});
}

TEST_F(TechniquesTest, options_reach_both_producers) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* producer : {"library", "paper"}) {
        const auto references_with = [&](const char* technique, const char* key, const char* value) {
            const OptionValues options{{"producer", producer}, {key, value}};
            const std::unique_ptr<Technique> made = make_technique(device(), technique, options);
            made->prepare(view.frame());
            return made->stats().references;
        };
        for (const char* technique : {"clustered", "tiled_light_trees", "hybrid_light_trees"})
            EXPECT_GT(references_with(technique, "tile_size", "16"), references_with(technique, "tile_size", "64"));
        for (const char* technique : {"clustered", "hybrid_light_trees"}) {
            EXPECT_GT(references_with(technique, "slice_count", "16"), references_with(technique, "slice_count", "4"));
            EXPECT_NE(references_with(technique, "slice_near", "1"), references_with(technique, "slice_near", "20"));
            EXPECT_NE(references_with(technique, "slice_far", "50"), references_with(technique, "slice_far", "900"));
        }
    }
}

TEST_F(TechniquesTest, switches_of_the_paper_reach_its_pipeline) {
    const View view = made_view(device(), 97, 60, 1500);
    const auto work_of = [&](const char* technique, OptionValues options) {
        options.emplace_back("producer", "paper");
        return summarize(records_of(device(), {"", technique, options}, view.frame()));
    };
    const WorkSummary clustered = work_of("clustered", {});
    EXPECT_GT(work_of("clustered", {{"listing4", "printed"}}).tested_mean, clustered.tested_mean);
    EXPECT_EQ(work_of("hybrid_light_trees", {{"heuristic", "lists"}}).tested_mean, clustered.tested_mean);
    EXPECT_LT(work_of("hybrid_light_trees", {{"heuristic", "e"}}).tested_mean, clustered.tested_mean);
    EXPECT_NE(work_of("tiled_light_trees", {{"sort_key", "near"}}).tested_mean,
              work_of("tiled_light_trees", {}).tested_mean);
    EXPECT_LT(work_of("tiled_light_trees", {{"leaf_size", "1"}}).tested_mean,
              work_of("tiled_light_trees", {{"leaf_size", "64"}}).tested_mean);
}

TEST_F(TechniquesTest, every_size_of_the_structure_is_exact) {
    const View view = made_view(device(), 97, 60, 1500);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const Variant variants[] = {
        {"tile_size=8", "clustered", {{"tile_size", "8"}}},
        {"tile_size=4096", "hybrid_light_trees", {{"tile_size", "4096"}}},
        {"slice_count=1", "clustered", {{"slice_count", "1"}}},
        {"slice_count=2", "hybrid_light_trees", {{"slice_count", "2"}}},
        {"slice_count=128", "clustered", {{"slice_count", "128"}}},
        {"leaf_size=1", "tiled_light_trees", {{"leaf_size", "1"}}},
        {"leaf_size=65535", "tiled_light_trees", {{"leaf_size", "65535"}}},
        {"slice_far=30", "clustered", {{"slice_near", "0.5"}, {"slice_far", "30"}}},
        {"windows of 8 pixels", "depth_windows", {{"tile_size", "8"}}},
        {"windows of 13 pixels", "depth_windows", {{"tile_size", "13"}}},
        {"windows of the whole image", "depth_windows", {{"tile_size", "4096"}}},
        {"windows of 8 pixels by depth", "depth_windows", {{"tile_size", "8"}, {"depth", "on"}}},
        {"windows of 13 pixels by depth", "depth_windows", {{"tile_size", "13"}, {"depth", "on"}}},
        {"windows of the whole image by depth", "depth_windows", {{"tile_size", "4096"}, {"depth", "on"}}},
        {"waves over tiles of 8 pixels", "depth_windows_wave", {{"tile_size", "8"}, {"wave", "64"}}},
        {"waves over tiles of 20 pixels", "depth_windows_wave", {{"tile_size", "20"}, {"wave", "64"}}},
        {"waves over tiles of 24 pixels", "depth_windows_wave", {{"tile_size", "24"}, {"wave", "32"}}},
        {"waves of 16 over tiles of 13 pixels", "depth_windows_wave", {{"tile_size", "13"}, {"wave", "16"}}},
        {"waves of 8", "depth_windows_wave", {{"tile_size", "24"}, {"wave", "8"}}},
        {"waves of 4", "depth_windows_wave", {{"tile_size", "20"}, {"wave", "4"}}},
        {"waves over the whole image", "depth_windows_wave", {{"tile_size", "4096"}, {"wave", "64"}}},
    };
    for (const Variant& variant : variants)
        expect_exact(compare(truth, records_of(device(), variant, view.frame()), view.width), variant.label);
}

TEST_F(TechniquesTest, tiles_of_windows_are_of_the_size_asked_for) {
    const View view = made_view(device(), 97, 60, 1500);
    const auto references_with = [&](const OptionValues& options) {
        const std::unique_ptr<Technique> technique = make_technique(device(), "depth_windows", options);
        technique->prepare(view.frame());
        return technique->stats().references;
    };
    EXPECT_GT(references_with({{"tile_size", "16"}}), references_with({{"tile_size", "64"}}));
    EXPECT_EQ(references_with({{"tile_size", "32"}}), references_with({})) << "the library's choice for few lights";
}

// Few lights in small tiles: where one affects a point there is a list, and elsewhere are tiles without any.
TEST_F(TechniquesTest, tiles_of_windows_without_lights_have_no_class) {
    const View view = made_view(device(), 97, 60, 5);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const std::unique_ptr<Technique> technique = make_technique(device(), "depth_windows", {{"tile_size", "8"}});
    technique->prepare(view.frame());
    const std::vector<CellClass> classes = technique->classify(view.frame());
    EXPECT_GT(std::ranges::count(classes, CellClass::none), 100);
    EXPECT_GT(summarize(truth).affecting_mean, 0.0);
    for (std::size_t pixel = 0; pixel < classes.size(); ++pixel)
        ASSERT_TRUE(truth[pixel].affecting == 0 || classes[pixel] == CellClass::list) << "pixel " << pixel;
}

// Figure 3 of Tiled Light Trees: a class per tile.
TEST_F(TechniquesTest, classes_are_those_of_the_cells_that_pixels_walk) {
    const View view = made_view(device(), 97, 60, 1500);
    const auto classes_of = [&](const char* name, const OptionValues& options) {
        const std::unique_ptr<Technique> technique = make_technique(device(), name, options);
        technique->prepare(view.frame());
        return technique->classify(view.frame());
    };
    const auto count = [](const std::vector<CellClass>& classes, CellClass wanted) {
        return std::ranges::count(classes, wanted);
    };
    const std::ptrdiff_t pixels = 97 * 60;
    EXPECT_TRUE(classes_of("brute_force", {}).empty());
    EXPECT_EQ(count(classes_of("clustered", {}), CellClass::list), pixels);
    EXPECT_EQ(count(classes_of("depth_windows", {}), CellClass::list), pixels);
    EXPECT_EQ(count(classes_of("tiled_light_trees", {}), CellClass::tree), pixels);
    EXPECT_EQ(count(classes_of("tiled_light_trees", {{"leaf_size", "65535"}}), CellClass::list), pixels);
    const OptionValues always{{"producer", "paper"}, {"heuristic", "e"}, {"leaf_size", "1"}, {"slice_count", "1"}};
    EXPECT_EQ(count(classes_of("hybrid_light_trees", always), CellClass::tree), pixels);
    const OptionValues never{{"producer", "paper"}, {"heuristic", "lists"}, {"leaf_size", "1"}};
    EXPECT_EQ(count(classes_of("hybrid_light_trees", never), CellClass::list), pixels);
    EXPECT_GT(count(classes_of("hybrid_light_trees", {}), CellClass::mixed), 0);
}

} // namespace manylights::lab
