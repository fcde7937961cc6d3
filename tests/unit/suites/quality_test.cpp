// The suite `quality`: its cases, and the tables that its rows are read by.

#include "lab/scene/error.h"
#include "lab/suites/quality.h"
#include "tests/unit/suites/sample_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace manylights::lab::suites {
namespace {

SuiteOptions built_in_scenes() {
    SuiteOptions options;
    options.scenes = {"canyon", "citadel", "bars"};
    return options;
}

TEST(QualityCases, cameras_for_every_count_and_the_path_for_the_main_ones) {
    const CaseList list = quality_cases(built_in_scenes());
    std::set<std::string> ids;
    std::size_t cameras = 0, frames = 0, timed = 0;
    for (const Case& c : list.cases) {
        ids.insert(case_id(c));
        (c.view.on_path ? frames : cameras) += 1;
        timed += c.rounds.shade != 0;
        EXPECT_EQ(c.width, 1920u);
        EXPECT_TRUE(std::none_of(c.techniques.begin(), c.techniques.end(),
                                 [](const TechniqueChoice& t) { return t.name == "brute_force"; }));
    }
    EXPECT_EQ(ids.size(), list.cases.size()) << "every case is another one";
    EXPECT_EQ(cameras, 3u * 5u * 4u);
    EXPECT_EQ(frames, 3u * 2u * 16u);
    EXPECT_EQ(timed, 3u * 2u * 4u);
}

TEST(QualityCases, the_overlap_is_looked_at_with_its_own_lights_and_without_the_path) {
    SuiteOptions options;
    options.scenes = {"view"};
    const CaseList list = quality_cases(options);
    ASSERT_EQ(list.cases.size(), 4u);
    for (const Case& c : list.cases) {
        EXPECT_EQ(c.scene.name, "canyon");
        EXPECT_EQ(c.lights.distribution, "view");
        EXPECT_EQ(c.lights.count, 65536u);
        EXPECT_FALSE(c.view.on_path);
        EXPECT_NE(c.rounds.shade, 0u);
        // The finest lists are left out: no buffer of a software device holds them.
        EXPECT_EQ(std::count_if(c.techniques.begin(), c.techniques.end(),
                                [](const TechniqueChoice& t) { return t.name == "clustered"; }),
                  2);
    }
}

TEST(QualityCases, quick_is_a_small_part) {
    SuiteOptions options = built_in_scenes();
    options.quick = true;
    EXPECT_LT(quality_cases(options).cases.size(), 40u);
}

TEST(QualityCases, options_narrow_it_down) {
    SuiteOptions options;
    options.scenes = {"bars"};
    options.lights = {100, 200};
    options.techniques = {"clustered"};
    options.views = {"path"};
    options.width = 64;
    options.height = 36;
    const CaseList list = quality_cases(options);
    ASSERT_EQ(list.cases.size(), 2u * 16u);
    for (const Case& c : list.cases) {
        EXPECT_TRUE(c.view.on_path);
        EXPECT_EQ(c.scene.name, "bars");
        EXPECT_EQ(c.height, 36u);
        ASSERT_EQ(c.techniques.size(), 1u);
        EXPECT_EQ(c.techniques[0].options, (OptionValues{{"tile_size", "48"}, {"slice_count", "16"}}));
    }
}

std::vector<OptionValues> options_of_clustered(const Case& c) {
    std::vector<OptionValues> found;
    for (const TechniqueChoice& technique : c.techniques)
        if (technique.name == "clustered") found.push_back(technique.options);
    return found;
}

TEST(QualityCases, lists_have_rivals_of_finer_grids_where_lights_are_many) {
    const OptionValues coarse{{"tile_size", "48"}, {"slice_count", "16"}};
    const OptionValues fine{{"tile_size", "32"}, {"slice_count", "64"}, {"cell_test", "tight"}, {"loop", "wave"}};
    const OptionValues finest{{"tile_size", "16"}, {"slice_count", "128"}, {"cell_test", "tight"}, {"loop", "wave"}};
    SuiteOptions options = built_in_scenes();
    for (const bool quick : {false, true}) {
        options.quick = quick;
        std::size_t with_rivals = 0;
        for (const Case& c : quality_cases(options).cases) {
            const std::uint32_t count = c.lights.count;
            const bool wanted = count == 65536 || (!quick && (count == 8192 || count == 1048576));
            with_rivals += wanted;
            EXPECT_EQ(options_of_clustered(c),
                      wanted ? (std::vector<OptionValues>{coarse, fine, finest}) : std::vector<OptionValues>{coarse})
                << count << " lights";
        }
        EXPECT_EQ(with_rivals, quick ? 3u * (1 + 2) : 3u * (3 * 4 + 2 * 16));
    }
    options.techniques = {"exact"};
    for (const Case& c : quality_cases(options).cases) EXPECT_EQ(c.techniques.size(), 1u);
}

TEST(QualityCases, a_technique_is_left_out_above_its_cap_with_the_reason) {
    SuiteOptions options;
    options.scenes = {"bars"};
    options.lights = {4096, 4097};
    options.techniques = {"exact", "brute_force"};
    const CaseList list = quality_cases(options);
    ASSERT_FALSE(list.cases.empty());
    for (const Case& c : list.cases) EXPECT_EQ(c.techniques.size(), c.lights.count == 4096 ? 2u : 1u);
    ASSERT_EQ(list.skipped.size(), 1u);
    EXPECT_EQ(list.skipped[0], "brute_force: only up to 4096 lights, for it tests each light at each point");
    options.lights = {4096};
    EXPECT_TRUE(quality_cases(options).skipped.empty());
}

TEST(QualityCases, masks_of_many_lights_have_larger_tiles) {
    SuiteOptions options;
    options.scenes = {"bars"};
    options.lights = {65536, 1048576};
    options.techniques = {"z_bins"};
    for (const Case& c : quality_cases(options).cases) {
        ASSERT_EQ(c.techniques.size(), 1u);
        EXPECT_EQ(c.techniques[0].options,
                  c.lights.count == 65536 ? OptionValues{} : (OptionValues{{"tile_size", "64"}}));
    }
}

TEST(QualityCases, a_scene_that_is_not_there_is_skipped_with_the_reason) {
    SuiteOptions options;
    options.scenes = {"sponza"};
    options.scene_folder = "/no/such/folder";
    const CaseList list = quality_cases(options);
    EXPECT_TRUE(list.cases.empty());
    ASSERT_EQ(list.skipped.size(), 1u);
    EXPECT_EQ(list.skipped[0], "sponza: skipped, for /no/such/folder/sponza/sponza.glb is not there");
}

TEST(QualityCases, unknown_names_are_refused_with_the_choices) {
    SuiteOptions options;
    options.scenes = {"moon"};
    EXPECT_THROW(quality_cases(options), InputError);
    options = {};
    options.views = {"side"};
    EXPECT_THROW(quality_cases(options), InputError);
}

Row row_with_cost(const std::string& technique, const std::string& camera, double tested, double affecting,
                  double cost) {
    Row row = sample_row(technique, camera);
    row["tested_mean"] = tested;
    row["affecting_mean"] = affecting;
    row["wave_cost_64"] = cost;
    return row;
}

std::string line_with(const std::string& text, const std::string& start, std::size_t from = 0) {
    const std::size_t at = text.find(start, from);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

// (30 + 10) / (2 + 6), not the mean of 15 and 1.67.
TEST(QualityTables, ratios_are_of_the_means_over_the_cameras) {
    const std::vector<Row> rows{row_with_cost("clustered", "a", 30, 2, 40), row_with_cost("clustered", "b", 10, 6, 20)};
    const std::string line = line_with(quality_tables(rows), "| clustered");
    EXPECT_NE(line.find(" 5.00 |"), std::string::npos) << line;
    EXPECT_NE(line.find(" 30.0 |"), std::string::npos) << "mean cost; " << line;
}

TEST(QualityTables, the_path_shows_best_worst_and_the_distance_from_exact) {
    const std::vector<Row> rows{row_with_cost("exact", "path:0", 1, 1, 4),
                                row_with_cost("exact", "path:0.0625", 1, 1, 10),
                                row_with_cost("clustered", "path:0", 4, 1, 40),
                                row_with_cost("clustered", "path:0.0625", 4, 1, 80),
                                row_with_cost("hybrid_light_trees", "path:0", 2, 1, 20),
                                row_with_cost("hybrid_light_trees", "path:0.0625", 2, 1, 30)};
    const std::string text = quality_tables(rows);
    const std::string line = line_with(text, "| clustered");
    for (const char* cell : {" 40.0 |", " 60.0 |", " 80.0 |", " 2.00 |", " 0.38 |", " 10.00 |", " 4.00 |"})
        EXPECT_NE(line.find(cell), std::string::npos) << cell << " in " << line;
}

Row with_options(Row row, const Row& options) {
    row["options"] = options;
    return row;
}

TEST(QualityTables, rows_of_one_technique_with_other_options_are_not_mixed) {
    const Row coarse{{"tile_size", "48"}, {"slice_count", "16"}};
    const Row fine{{"tile_size", "32"}, {"slice_count", "64"}, {"cell_test", "tight"}, {"leaf_size", "4"}};
    const std::vector<Row> rows{with_options(row_with_cost("clustered", "a", 30, 3, 40), coarse),
                                with_options(row_with_cost("clustered", "a", 6, 3, 12), fine),
                                row_with_cost("exact", "a", 3, 3, 3),
                                with_options(row_with_cost("clustered", "b", 20, 2, 20), coarse),
                                with_options(row_with_cost("clustered", "b", 4, 2, 8), fine),
                                row_with_cost("exact", "b", 2, 2, 2),
                                with_options(row_with_cost("clustered", "path:0", 30, 3, 40), coarse),
                                with_options(row_with_cost("clustered", "path:0", 6, 3, 12), fine),
                                row_with_cost("exact", "path:0", 3, 3, 3)};
    const std::string text = quality_tables(rows);
    EXPECT_NE(text.find("mean of 2 cameras"), std::string::npos);
    const std::string coarse_line = line_with(text, "| clustered 48x16 "),
                      fine_start = "| clustered 32x64 tight leaf_size=4 ";
    EXPECT_NE(coarse_line.find(" 10.00 |"), std::string::npos) << text;
    EXPECT_NE(coarse_line.find(" 30.0 |"), std::string::npos) << text;
    EXPECT_NE(line_with(text, fine_start).find(" 2.00 |"), std::string::npos) << text;
    EXPECT_NE(line_with(text, fine_start).find(" 10.0 |"), std::string::npos) << text;
    const std::size_t path = text.find("of the path");
    EXPECT_NE(line_with(text, fine_start, path).find(" 4.00 |"), std::string::npos) << "worst over exact; " << text;
    EXPECT_NE(text.find("| exact "), std::string::npos) << "one set of options needs no more than the name";
}

TEST(QualityTables, a_wrong_light_set_has_no_figure) {
    Measurement m = sample_measurement("clustered");
    m.missing_points = 1;
    m.wrong = true;
    const std::vector<Row> rows{make_row(sample_view(), {}, m), sample_row("exact")};
    const std::string line = line_with(quality_tables(rows), "| clustered");
    EXPECT_NE(line.find("WRONG"), std::string::npos);
    EXPECT_EQ(line.find_first_of("0123456789"), std::string::npos) << line;
}

} // namespace
} // namespace manylights::lab::suites
