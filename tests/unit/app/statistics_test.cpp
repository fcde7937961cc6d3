#include "lab/app/statistics.h"

#include "lab/scene/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace manylights::lab::app {
namespace {

Measurement some_measurement() {
    Measurement m;
    m.technique = "clustered";
    m.options = {{"tile_size", "32"}};
    m.work.tested_mean = 24.5;
    m.stats.references = 7;
    m.stats.build_ms = {3.0, 1.0, 2.0, 10.0};
    m.light_set_hash = 0xABCu;
    return m;
}

nlohmann::ordered_json row_of(const Measurement& measurement) {
    Selectors selectors;
    selectors.width = 64;
    selectors.height = 36;
    gpu::DeviceInfo device;
    device.name = "card";
    device.version = "driver 1";
    return statistics_row(selectors, "street", device, measurement);
}

nlohmann::ordered_json some_row() { return row_of(some_measurement()); }

TEST(Statistics, keys_are_those_of_the_shared_schema) {
    std::vector<std::string> keys;
    const nlohmann::ordered_json row = some_row();
    for (const auto& item : row.items()) keys.push_back(item.key());
    EXPECT_EQ(keys,
              (std::vector<std::string>{
                  "technique",      "options",       "scene",      "distribution",    "lights",     "seed",
                  "camera",         "width",         "height",     "device",          "driver",     "visible_lights",
                  "tested_mean",    "tested_p95",    "tested_max", "affecting_mean",  "nodes_mean", "references_mean",
                  "wave_cost_64",   "wave_cost_32",  "references", "structure_bytes", "build_ms",   "shade_ms",
                  "light_set_hash", "missing_points"}));
}

TEST(Statistics, times_are_minimum_median_maximum_and_null_where_not_measured) {
    const nlohmann::ordered_json row = some_row();
    EXPECT_EQ(row["build_ms"].dump(), R"({"min":1.0,"median":2.5,"max":10.0})");
    EXPECT_EQ(row["shade_ms"].dump(), R"({"min":null,"median":null,"max":null})");
    EXPECT_TRUE(row["wave_cost_64"].is_null());
    EXPECT_TRUE(row["missing_points"].is_null());
    EXPECT_EQ(row["options"].dump(), R"({"tile_size":"32"})");
    EXPECT_EQ(row["light_set_hash"], "0000000000000abc");
    EXPECT_EQ(row["camera"], "street");
}

TEST(Statistics, wave_costs_are_means_with_the_default_weights) {
    Measurement m = some_measurement();
    m.waves.emplace();
    m.waves->lanes_64 = {2, 60, 10, 8, 4, 0};
    m.waves->lanes_32 = {4, 80, 10, 8, 0, 2};
    const nlohmann::ordered_json row = row_of(m);
    EXPECT_EQ(row["wave_cost_64"], 30.0 + 2.0 + 0.5);
    EXPECT_EQ(row["wave_cost_32"], 20.0 + 1.0 + 1.5);
}

TEST(Statistics, one_row_is_an_object_and_several_are_an_array) {
    const std::string path = testing::TempDir() + "manylights_statistics_test.json";
    write_statistics(path, {some_row()});
    EXPECT_TRUE(nlohmann::json::parse(std::ifstream(path)).is_object());
    write_statistics(path, {some_row(), some_row()});
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(path)).size(), 2u);
    EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
    std::filesystem::remove(path);
}

TEST(Statistics, a_folder_that_does_not_exist_is_refused_by_name) {
    for (const auto& attempt : {+[] { check_statistics_path("/no/such/folder/a.json"); },
                                +[] { write_statistics("/no/such/folder/a.json", {some_row()}); }}) {
        try {
            attempt();
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(),
                         "--stats '/no/such/folder/a.json': cannot be written: No such file or directory");
        }
    }
}

} // namespace
} // namespace manylights::lab::app
