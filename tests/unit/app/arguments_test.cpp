#include "lab/app/arguments.h"

#include "lab/scene/error.h"

#include <gtest/gtest.h>

namespace manylights::lab::app {
namespace {

std::string refusal(const std::vector<std::string>& arguments) {
    try {
        parse_command_line(arguments);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string render_refusal(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "--out", "a.png"});
    return refusal(arguments);
}

TEST(Arguments, render_has_sensible_defaults_for_everything_but_the_file) {
    const auto render = std::get<RenderArguments>(parse_command_line({"render", "--out", "a.png"}));
    EXPECT_EQ(render.selectors.scene, "canyon");
    EXPECT_EQ(render.selectors.lights.count, 65536u);
    EXPECT_EQ(render.selectors.lights.distribution, "volume");
    EXPECT_TRUE(render.selectors.scene_distribution);
    EXPECT_EQ(render.selectors.lights.radius, "auto");
    EXPECT_EQ(render.selectors.detail, Detail::full);
    EXPECT_EQ(render.selectors.width, 960u);
    EXPECT_EQ(render.selectors.height, 540u);
    EXPECT_FALSE(render.selectors.size_given);
    EXPECT_EQ(render.selectors.points, "");
    EXPECT_EQ(render.techniques, std::vector<std::string>{"hybrid_light_trees"});
    EXPECT_EQ(render.view, ViewKind::shaded);
    EXPECT_FALSE(render.scale_max);
}

TEST(Arguments, render_takes_every_option) {
    const auto render = std::get<RenderArguments>(parse_command_line({"render",
                                                                      "--scene",
                                                                      "bars",
                                                                      "--lights",
                                                                      "0",
                                                                      "--distribution",
                                                                      "surface",
                                                                      "--seed",
                                                                      "4294967295",
                                                                      "--radius",
                                                                      "0.5:2",
                                                                      "--kinds",
                                                                      "point",
                                                                      "--technique",
                                                                      "clustered",
                                                                      "--set",
                                                                      "tile_size=32",
                                                                      "--set",
                                                                      "slice_count=8",
                                                                      "--camera",
                                                                      "path:0.5",
                                                                      "--size",
                                                                      "8192x1",
                                                                      "--device",
                                                                      "0",
                                                                      "--detail",
                                                                      "low",
                                                                      "--view",
                                                                      "references",
                                                                      "--scale-max",
                                                                      "140",
                                                                      "--out",
                                                                      "b.exr",
                                                                      "--stats",
                                                                      "b.json",
                                                                      "--points",
                                                                      "b.points",
                                                                      "--validation"}));
    EXPECT_EQ(render.selectors.lights.count, 0u);
    EXPECT_EQ(render.selectors.lights.seed, 4294967295u);
    EXPECT_EQ(render.selectors.settings, (OptionValues{{"tile_size", "32"}, {"slice_count", "8"}}));
    EXPECT_EQ(render.selectors.width, 8192u);
    EXPECT_EQ(render.selectors.height, 1u);
    EXPECT_TRUE(render.selectors.size_given);
    EXPECT_FALSE(render.selectors.scene_distribution);
    EXPECT_EQ(render.selectors.points, "b.points");
    EXPECT_EQ(render.selectors.detail, Detail::low);
    EXPECT_EQ(render.view, ViewKind::references);
    EXPECT_EQ(render.scale_max, 140.0);
    EXPECT_EQ(render.stats, "b.json");
    EXPECT_TRUE(render.selectors.validation);
}

TEST(Arguments, verify_takes_all_techniques_or_a_list) {
    const auto all = std::get<VerifyArguments>(parse_command_line({"verify"}));
    EXPECT_EQ(all.techniques.size(), technique_infos().size());
    EXPECT_EQ(all.selectors.width, 256u);
    EXPECT_EQ(all.selectors.height, 144u);
    const auto two = std::get<VerifyArguments>(parse_command_line(
        {"verify", "--techniques", "clustered,hybrid_light_trees", "--remove-one-light", "clustered"}));
    EXPECT_EQ(two.techniques, (std::vector<std::string>{"clustered", "hybrid_light_trees"}));
    EXPECT_EQ(two.remove_one_light, "clustered");
    EXPECT_TRUE(all.all_techniques);
    EXPECT_FALSE(two.all_techniques);
    EXPECT_TRUE(std::get<VerifyArguments>(parse_command_line({"verify", "--techniques", "all"})).all_techniques);
}

TEST(Arguments, verify_takes_a_truth) {
    const auto truth_of = [](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"verify"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return std::get<VerifyArguments>(parse_command_line(arguments)).truth;
    };
    EXPECT_EQ(truth_of({}), TruthKind::automatic);
    EXPECT_EQ(truth_of({"--truth", "auto"}), TruthKind::automatic);
    EXPECT_EQ(truth_of({"--truth", "brute_force"}), TruthKind::brute_force);
    EXPECT_EQ(truth_of({"--truth", "grid", "--remove-one-light", "grid"}), TruthKind::grid);
    EXPECT_EQ(refusal({"verify", "--truth", "exact"}), "--truth 'exact': must be one of auto, brute_force, grid");
}

TEST(Arguments, the_last_of_a_repeated_option_counts) {
    const auto render = std::get<RenderArguments>(
        parse_command_line({"render", "--out", "a.png", "--size", "8x8", "--size", "9x9", "--out", "b.png"}));
    EXPECT_EQ(render.selectors.width, 9u);
    EXPECT_EQ(render.out, "b.png");
}

TEST(Arguments, list_names_what) {
    EXPECT_EQ(std::get<ListArguments>(parse_command_line({"list", "devices"})).what, ListKind::devices);
    EXPECT_EQ(refusal({"list", "lamps"}), "list 'lamps': must be one of scenes, techniques, suites, devices");
}

TEST(Arguments, numbers_outside_their_range_are_refused_with_the_range) {
    EXPECT_EQ(render_refusal({"--lights", "16777217"}),
              "--lights '16777217': must be a whole number from 0 to 16777216");
    EXPECT_EQ(render_refusal({"--lights", "-1"}), "--lights '-1': must be a whole number from 0 to 16777216");
    EXPECT_EQ(render_refusal({"--lights", "1e3"}), "--lights '1e3': must be a whole number from 0 to 16777216");
    EXPECT_EQ(render_refusal({"--seed", "4294967296"}),
              "--seed '4294967296': must be a whole number from 0 to 4294967295");
    EXPECT_EQ(render_refusal({"--scale-max", "0"}), "--scale-max '0': must be a number above 0");
    EXPECT_EQ(render_refusal({"--scale-max", "inf"}), "--scale-max 'inf': must be a number above 0");
}

TEST(Arguments, sizes_need_two_sides_in_range) {
    for (const char* size : {"0x5", "5x0", "8193x5", "5", "5x", "x5", "5x5x5", "-5x5", " 5x5", ""})
        EXPECT_EQ(render_refusal({"--size", size}),
                  std::string("--size '") + size + "': must be WIDTHxHEIGHT, each from 1 to 8192");
}

TEST(Arguments, names_are_refused_with_the_choices) {
    EXPECT_EQ(render_refusal({"--view", "depth"}),
              "--view 'depth': must be one of shaded, tested, affecting, nodes, references, structure");
    EXPECT_EQ(render_refusal({"--detail", "high"}), "--detail 'high': must be one of low, full");
    EXPECT_NE(render_refusal({"--technique", "magic"}).find("--technique 'magic': unknown technique; there are "),
              std::string::npos);
    EXPECT_NE(render_refusal({"--kinds", "point,spot"}).find("this version shades point lights"), std::string::npos);
    EXPECT_NE(render_refusal({"--set", "tile_size"}).find("must be KEY=VALUE"), std::string::npos);
    EXPECT_NE(render_refusal({"--set", "no_such_key=3"}).find("unknown option of hybrid_light_trees; there are "),
              std::string::npos);
}

TEST(Arguments, pictures_have_an_extension_that_says_their_format) {
    EXPECT_EQ(render_refusal({"--out", "a.jpg"}), "--out 'a.jpg': must be a file name that ends in .png or .exr");
    EXPECT_EQ(render_refusal({"--panels", "{}.gif"}),
              "--panels '{}.gif': must be a file name that ends in .png or .exr");
    EXPECT_EQ(render_refusal({"--panels", "a.png"}),
              "--panels 'a.png': must be a file name with {} where the technique's name goes");
}

TEST(Arguments, techniques_are_not_given_twice) {
    EXPECT_EQ(refusal({"verify", "--techniques", "clustered,clustered"}), "--techniques 'clustered': is given twice");
}

TEST(Arguments, usage_errors_are_one_line_with_a_hint) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"paint"},
                                                      {"render"},
                                                      {"render", "--out"},
                                                      {"render", "--out", "a.png", "--colour"},
                                                      {"verify", "surplus"}}) {
        const std::string text = refusal(arguments);
        EXPECT_TRUE(text.starts_with("usage: ")) << text;
        EXPECT_NE(text.find("--help`"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST(Arguments, help_and_version_are_information) {
    EXPECT_NE(std::get<Information>(parse_command_line({"--help"})).text.find("verify"), std::string::npos);
    const std::string help = std::get<Information>(parse_command_line({"verify", "--help"})).text;
    EXPECT_NE(help.find("--techniques"), std::string::npos);
    EXPECT_EQ(help.find("--remove-one-light"), std::string::npos);
    EXPECT_EQ(std::get<Information>(parse_command_line({"--version"})).text, "manylights 0.1\n");
}

} // namespace
} // namespace manylights::lab::app
