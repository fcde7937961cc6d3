// The options of lists and trees that Tiled Light Trees varies: walks of the shaders, the builds of its pipeline. Exact
// in every one of them, and what each may change beside.

#include "lab/scene/error.h"
#include "lab/techniques/host_structure.h"
#include "lab/techniques/light_records.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <cstring>

namespace manylights::lab {

namespace {

struct ImageSize {
    std::uint32_t width, height;
};
// The last has tiles side by side and one below the other, cut by the image's edges.
constexpr ImageSize kSizes[] = {{1, 1}, {47, 33}, {97, 60}};

OptionValues operator+(OptionValues options, const OptionValues& more) {
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

const OptionValues kPaper{{"producer", "paper"}}, kThree{{"paths", "three"}}, kLds{{"lds", "on"}},
    kDuplicated{{"lights", "duplicated"}};

const char* const kTrees = "tiled_light_trees";
const char* const kHybrid = "hybrid_light_trees";

struct Case {
    const char* technique;
    OptionValues options;
};

std::vector<Case> walk_cases() {
    return {{"clustered", kDuplicated},   {kTrees, kLds},         {kTrees, kDuplicated},
            {kTrees, kLds + kDuplicated}, {kHybrid, kThree},      {kHybrid, kLds},
            {kHybrid, kThree + kLds},     {kHybrid, kDuplicated}, {kHybrid, kThree + kLds + kDuplicated}};
}

std::vector<Case> build_cases() {
    const OptionValues entry{{"entry", "slice"}}, cells{{"sort", "cell"}}, down{{"tree", "top_down"}};
    return {{kTrees, kPaper + cells},
            {kTrees, kPaper + down},
            {kTrees, kPaper + entry},
            {kTrees, kPaper + entry + down + cells + kLds + OptionValues{{"slice_count", "128"}, {"leaf_size", "1"}}},
            {kHybrid, kPaper + cells},
            {kHybrid, kPaper + down + kThree},
            {kHybrid, kPaper + OptionValues{{"list_bounds", "lights"}, {"heuristic", "lists"}} + kThree}};
}

class TreeOptions : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const View& view, const Case& test) {
        std::unique_ptr<Technique> technique = make_technique(device(), test.technique, test.options);
        technique->prepare(view.frame());
        return technique;
    }

    WorkSummary work(const View& view, const Case& test) {
        return summarize(prepared(view, test)->record(view.frame()));
    }

    void expect_exact(const View& view, const std::vector<Case>& cases, const std::string& what) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        for (const Case& test : cases) {
            const VerifyResult result = compare(truth, prepared(view, test)->record(view.frame()), view.width);
            EXPECT_EQ(result.wrong_pixels, 0u)
                << what << ", " << test.technique << ' ' << ::testing::PrintToString(test.options);
        }
    }

    // A walk differs from the cursor in what it reads from where, in nothing that a pixel finds, counts or adds up.
    void expect_pixels_of_the_cursor(const View& view, const Case& test, const OptionValues& common) {
        const std::unique_ptr<Technique> cursor = prepared(view, {test.technique, common});
        const std::unique_ptr<Technique> walk = prepared(view, {test.technique, common + test.options});
        const std::vector<PixelRecord> records = cursor->record(view.frame());
        EXPECT_EQ(std::memcmp(records.data(), walk->record(view.frame()).data(), records.size() * sizeof(PixelRecord)),
                  0);
        EXPECT_EQ(cursor->shade(view.frame()), walk->shade(view.frame()));
        EXPECT_EQ(cursor->waves(view.frame()), walk->waves(view.frame()));
        EXPECT_EQ(cursor->classify(view.frame()), walk->classify(view.frame()));
    }
};

} // namespace

TEST_F(TreeOptions, are_exact_for_every_count_and_size) {
    const std::vector<Case> walks = walk_cases(), builds = build_cases();
    for (const ImageSize size : kSizes) {
        for (const std::uint32_t count : {size.width == 1 ? 1u : 0u, 1500u}) {
            const View view = made_view(device(), size.width, size.height, count);
            expect_exact(view, walks, std::to_string(count) + " lights");
            expect_exact(view, builds, std::to_string(count) + " lights");
        }
    }
}

// One tile with more lights than 16 bits count, and trees with more nodes than workgroup memory holds.
TEST_F(TreeOptions, are_exact_for_80000_lights_in_a_tile) {
    const View view = made_view(device(), 24, 24, 80000);
    const OptionValues small_leaves{{"leaf_size", "1"}};
    const std::vector<Case> cases{
        {kTrees, small_leaves + kLds},
        {kTrees, kPaper + small_leaves + kLds + OptionValues{{"entry", "slice"}}},
        {kTrees, kPaper + small_leaves + OptionValues{{"tree", "top_down"}}},
        {kTrees, kPaper + OptionValues{{"sort", "cell"}}},
        {kHybrid, kPaper + kThree + kLds + OptionValues{{"heuristic", "lists"}, {"slice_count", "1"}}}};
    expect_exact(view, cases, "80000 lights");
}

// Tiles of 48 pixels hold whole workgroups; those of 20 cut some of them, whose pixels then walk different
// trees.
TEST_F(TreeOptions, walks_give_the_pixels_of_the_cursor) {
    for (const ImageSize size : kSizes) {
        const View view = made_view(device(), size.width, size.height, 1500);
        for (const Case& test : walk_cases()) {
            SCOPED_TRACE(::testing::PrintToString(test.options) + " of " + test.technique);
            for (const char* tile_size : {"20", "48"})
                expect_pixels_of_the_cursor(view, test, {{"tile_size", tile_size}});
        }
    }
}

// A tile per workgroup, and in it the depths of one slice or of two: so there are workgroups that walk lists alone,
// trees alone, and both.
TEST_F(TreeOptions, three_paths_serve_workgroups_of_one_kind_and_of_both) {
    View view = made_view(device(), 97, 60, 3000);
    constexpr float kDepths[] = {0.4f, 6.0f, 20.0f, 60.0f, 150.0f, 400.0f};
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const std::size_t block = pixel / 97 / 8 * 13 + pixel % 97 / 8;
        PointPosition& point = view.positions[pixel];
        if (point.depth == 0.0f) continue;
        const float depth = kDepths[(block + (block % 4 == 0 ? pixel % 2 : 0)) % 6];
        point.position *= depth / point.depth;
        point.depth = depth;
    }
    view.points.positions().upload(view.positions);
    const OptionValues common = kPaper + OptionValues{{"tile_size", "8"}, {"leaf_size", "1"}};
    for (const OptionValues& options : {kThree, kThree + kLds, kLds}) {
        expect_pixels_of_the_cursor(view, {kHybrid, options}, common);
        expect_exact(view, {{kHybrid, common + options}}, "blocks of a depth");
    }
    const std::vector<CellClass> classes = prepared(view, {kHybrid, common})->classify(view.frame());
    for (const CellClass wanted : {CellClass::list, CellClass::tree, CellClass::mixed})
        EXPECT_GT(std::ranges::count(classes, wanted), 100) << int(wanted);
}

TEST_F(TreeOptions, duplicated_lights_take_a_record_per_reference) {
    const View view = made_view(device(), 97, 60, 1500);
    for (const char* technique : {"clustered", kTrees, kHybrid}) {
        const TechniqueStats indexed = prepared(view, {technique, {}})->stats();
        const TechniqueStats duplicated = prepared(view, {technique, kDuplicated})->stats();
        EXPECT_EQ(duplicated.references, indexed.references);
        EXPECT_EQ(duplicated.structure_bytes - indexed.structure_bytes,
                  indexed.references * (sizeof(LightRecord) - sizeof(std::uint32_t)));
        EXPECT_EQ(duplicated.stages.back().name, "duplicate");
    }
}

TEST_F(TreeOptions, top_down_trees_and_bounds_of_lists_spare_tests) {
    const View view = made_view(device(), 97, 60, 3000);
    const WorkSummary up = work(view, {kTrees, kPaper});
    EXPECT_LT(work(view, {kTrees, kPaper + OptionValues{{"tree", "top_down"}}}).tested_mean, up.tested_mean);
    const OptionValues lists = kPaper + OptionValues{{"heuristic", "lists"}, {"tile_size", "8"}};
    EXPECT_LT(work(view, {kHybrid, lists + OptionValues{{"list_bounds", "lights"}}}).tested_mean,
              work(view, {kHybrid, lists}).tested_mean);
}

// The same lights are tested, and fewer nodes visited: those above the entry are not.
TEST_F(TreeOptions, entries_per_slice_spare_nodes) {
    const View view = made_view(device(), 97, 60, 3000);
    const WorkSummary root = work(view, {kTrees, kPaper});
    const WorkSummary few = work(view, {kTrees, kPaper + OptionValues{{"entry", "slice"}, {"slice_count", "4"}}});
    const WorkSummary many = work(view, {kTrees, kPaper + OptionValues{{"entry", "slice"}, {"slice_count", "128"}}});
    EXPECT_EQ(few.tested_mean, root.tested_mean);
    EXPECT_EQ(many.tested_mean, root.tested_mean);
    EXPECT_LT(few.nodes_mean, root.nodes_mean);
    EXPECT_LT(many.nodes_mean, few.nodes_mean);
}

TEST_F(TreeOptions, cells_sorted_on_their_own_prune_like_sorted_lights) {
    const View view = made_view(device(), 97, 60, 3000);
    for (const char* technique : {kTrees, kHybrid}) {
        const double all = work(view, {technique, kPaper}).tested_mean;
        EXPECT_NEAR(work(view, {technique, kPaper + OptionValues{{"sort", "cell"}}}).tested_mean, all, 0.02 * all);
    }
}

} // namespace manylights::lab
