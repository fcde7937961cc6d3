// The suite `build`: its steps, its rows, and the tables that they are read by.

#include "lab/scene/error.h"
#include "lab/suites/build.h"

#include <gtest/gtest.h>

#include <set>

namespace manylights::lab::suites {
namespace {

SuiteOptions small(std::vector<std::string> scenes) {
    SuiteOptions options;
    options.scenes = std::move(scenes);
    options.detail = Detail::low;
    options.width = 64;
    options.height = 36;
    return options;
}

std::vector<Row> rows_of(const SuiteOptions& options) {
    std::vector<Row> rows;
    RunContext context;
    context.say = [](const std::string&) {};
    for (const Step& step : build_steps(options).steps)
        for (const Row& row : step.run(context).rows) rows.push_back(row);
    return rows;
}

TEST(BuildSteps, every_count_in_every_scene_and_the_overlap_with_its_own) {
    const StepList list = build_steps(small({"canyon", "view"}));
    std::set<std::string> ids;
    for (const Step& step : list.steps) ids.insert(step.id);
    EXPECT_EQ(list.steps.size(), 10u + 1u);
    EXPECT_EQ(ids.size(), list.steps.size()) << "every step is another one";
    EXPECT_EQ(list.steps.back().label, "canyon view 65536");
}

TEST(BuildSteps, a_scene_that_is_not_there_is_skipped_with_a_line) {
    SuiteOptions options = small({"sponza"});
    options.scene_folder = "nowhere";
    const StepList list = build_steps(options);
    EXPECT_TRUE(list.steps.empty());
    ASSERT_FALSE(list.skipped.empty());
    EXPECT_NE(list.skipped.back().find("nowhere/sponza/sponza.glb is not there"), std::string::npos);
}

TEST(BuildSteps, what_the_suite_has_not_is_refused) {
    SuiteOptions options = small({"canyon"});
    options.techniques = {"exact"};
    EXPECT_THROW(build_steps(options), InputError);
    options.techniques.clear();
    options.views = {"path"};
    EXPECT_THROW(build_steps(options), InputError);
}

TEST(BuildRows, have_the_columns_of_the_suite_and_hold_together) {
    SuiteOptions options = small({"bars"});
    options.lights = {300};
    options.repeat = 3;
    const std::vector<Row> rows = rows_of(options);
    ASSERT_GE(rows.size(), 8u);
    std::uint64_t windows_references = 0;
    for (const Row& row : rows) {
        EXPECT_EQ(row_fault(row, build_columns()), "");
        EXPECT_EQ(row["build_ms"]["repeats"], 3);
        EXPECT_EQ(row["paper_over_this"]["repeats"], 3);
        if (row["builder"] == "windows 48") windows_references = row["references"];
    }
    EXPECT_EQ(rows.front()["paper_over_this"]["max"], 1.0);
    EXPECT_EQ(rows.back()["builder"], "floor");
    EXPECT_EQ(rows.back()["this_over_floor"]["max"], 1.0);
    EXPECT_EQ(rows.back()["references"], windows_references);
    EXPECT_GT(windows_references, 0u);
}

TEST(BuildTables, a_line_per_builder_and_a_column_per_count) {
    SuiteOptions options = small({"bars"});
    options.lights = {0, 200};
    options.repeat = 1;
    const std::string text = build_tables(rows_of(options));
    EXPECT_NE(text.find("### bars (volume), 64x36: paper's pipeline over this, warm"), std::string::npos);
    EXPECT_NE(text.find(" 0 lights |"), std::string::npos);
    EXPECT_NE(text.find(" 200 lights |"), std::string::npos);
    EXPECT_NE(text.find("| windows 32 "), std::string::npos);
    EXPECT_EQ(text.find("of the build of 65,536 lights"), std::string::npos) << "nothing to compare with";
}

} // namespace
} // namespace manylights::lab::suites
