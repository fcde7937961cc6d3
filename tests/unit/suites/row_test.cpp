// Rows: the schema, what a row holds, and what is refused.

#include "lab/suites/csv.h"
#include "lab/suites/schema.h"
#include "tests/unit/suites/sample_rows.h"

#include <gtest/gtest.h>

#include <sstream>

namespace manylights::lab::suites {
namespace {

TEST(Row, keys_are_those_of_the_shared_schema_in_its_order) {
    std::vector<std::string> keys;
    const Row row = sample_row();
    for (const auto& item : row.items()) keys.push_back(item.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"technique",
                                              "options",
                                              "scene",
                                              "distribution",
                                              "lights",
                                              "seed",
                                              "camera",
                                              "width",
                                              "height",
                                              "device",
                                              "driver",
                                              "visible_lights",
                                              "points",
                                              "tested_mean",
                                              "tested_p95",
                                              "tested_max",
                                              "affecting_mean",
                                              "nodes_mean",
                                              "references_mean",
                                              "references_in_range_mean",
                                              "wave_cost_64",
                                              "wave_cost_32",
                                              "wave_cost_64_half",
                                              "wave_cost_64_double",
                                              "wave_cost_64_p99",
                                              "wave_tested_64",
                                              "wave_tested_32",
                                              "wave_affecting_64",
                                              "wave_affecting_32",
                                              "wave_nodes_64",
                                              "wave_checks_64",
                                              "references",
                                              "structure_bytes",
                                              "build_ms",
                                              "cold_build_ms",
                                              "stages_ms",
                                              "shade_ms",
                                              "shade_over_exact",
                                              "light_set_hash",
                                              "missing_points"}));
    EXPECT_EQ(row_fault(row, schema()), "");
}

TEST(Row, times_are_minimum_median_maximum_and_null_where_not_measured) {
    const Row row = sample_row();
    EXPECT_EQ(row["build_ms"].dump(), R"({"min":1.0,"median":2.5,"max":10.0,"repeats":4})");
    EXPECT_EQ(row["shade_ms"].dump(), R"({"min":null,"median":null,"max":null,"repeats":0})");
    EXPECT_EQ(row["stages_ms"]["plan"].dump(), R"({"min":0.5,"median":1.5,"max":2.0,"repeats":3})");
    EXPECT_EQ(row["options"].dump(), R"({"tile_size":"32"})");
    EXPECT_EQ(row["light_set_hash"], "0000000000000abc");
    EXPECT_EQ(row["camera"], "street");
}

// 10 waves of 300 tested, 40 nodes and 20 checks in all: 30 + 0.5 * 4 + 0.25 * 2.
TEST(Row, wave_figures_are_means_per_wave) {
    const Row row = sample_row();
    EXPECT_EQ(row["wave_tested_64"], 30.0);
    EXPECT_EQ(row["wave_affecting_64"], 8.0);
    EXPECT_EQ(row["wave_nodes_64"], 4.0);
    EXPECT_EQ(row["wave_checks_64"], 2.0);
    EXPECT_EQ(row["wave_cost_64"], 32.5);
    EXPECT_EQ(row["wave_cost_64_half"], 31.25);
    EXPECT_EQ(row["wave_cost_64_double"], 35.0);
    EXPECT_EQ(row["wave_tested_32"], 25.0);
}

TEST(Row, without_wave_figures_they_are_null) {
    Measurement m = sample_measurement("brute_force");
    m.waves.reset();
    const Row row = make_row(sample_view(), {}, m);
    EXPECT_TRUE(row["wave_cost_64"].is_null());
    EXPECT_EQ(row["tested_mean"], 24.5);
}

TEST(Row, a_wrong_light_set_leaves_no_figure) {
    Measurement m = sample_measurement("clustered");
    m.missing_points = 3;
    m.wrong = true;
    const Row row = make_row(sample_view(), {}, m);
    EXPECT_EQ(row["missing_points"], 3);
    for (const char* key : {"tested_mean", "wave_cost_64", "references", "structure_bytes", "light_set_hash"})
        EXPECT_TRUE(row[key].is_null()) << key;
    EXPECT_TRUE(row["build_ms"]["median"].is_null());
    EXPECT_EQ(row_fault(row, schema()), "");
}

TEST(Row, whatever_does_not_fit_the_schema_is_named) {
    const auto fault = [](auto change) {
        Row row = sample_row();
        change(row);
        return row_fault(row, schema());
    };
    EXPECT_EQ(fault([](Row& row) { row.erase("seed"); }), "seed: is missing");
    EXPECT_EQ(fault([](Row& row) { row["extra"] = 1; }), "extra: is no column of the schema");
    EXPECT_EQ(fault([](Row& row) { row["lights"] = -1; }), "lights: is -1, must be a whole number, not negative");
    EXPECT_EQ(fault([](Row& row) { row["lights"] = nullptr; }),
              "lights: is null, must be a whole number, not negative");
    EXPECT_EQ(fault([](Row& row) { row["tested_mean"] = "1"; }),
              "tested_mean: is \"1\", must be a finite number, not negative");
    EXPECT_EQ(fault([](Row& row) { row["light_set_hash"] = "ABC"; }),
              "light_set_hash: is \"ABC\", must be 16 hexadecimal digits");
    EXPECT_NE(fault([](Row& row) { row["build_ms"]["min"] = 99.0; }), "");
    EXPECT_NE(fault([](Row& row) { row["build_ms"]["max"] = nullptr; }), "");
    EXPECT_NE(fault([](Row& row) { row["build_ms"]["repeats"] = 0; }), "");
    EXPECT_NE(fault([](Row& row) { row["shade_ms"]["repeats"] = 1; }), "");
    EXPECT_NE(fault([](Row& row) { row["stages_ms"]["plan"] = 1.0; }), "");
    EXPECT_NE(fault([](Row& row) { row["options"]["tile_size"] = 32; }), "");
    EXPECT_EQ(row_fault(Row::array(), schema()), "must be an object");
}

TEST(Csv, has_a_title_per_cell_and_quotes_what_needs_it) {
    const std::vector<Row> rows{sample_row()};
    std::istringstream lines(csv_text(rows, schema()));
    std::string titles, cells;
    std::getline(lines, titles);
    std::getline(lines, cells);
    EXPECT_TRUE(titles.starts_with("technique,options,scene,"));
    EXPECT_NE(titles.find(",build_ms_min,build_ms_median,build_ms_max,build_ms_repeats,"), std::string::npos);
    EXPECT_NE(cells.find(",\"driver 1, new\","), std::string::npos);
    EXPECT_NE(cells.find(",1.0,2.5,10.0,4,"), std::string::npos);
    EXPECT_NE(cells.find(",plan=1.5 write=1.0,"), std::string::npos);
    // One comma is inside quotes.
    EXPECT_EQ(std::count(titles.begin(), titles.end(), ',') + 1, std::count(cells.begin(), cells.end(), ','));
}

} // namespace
} // namespace manylights::lab::suites
