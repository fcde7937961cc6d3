#include "lab/app/saved_view.h"

#include "lab/renderer/point_file.h"
#include "lab/scene/error.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace manylights::lab::app {
namespace {

const std::string kFile = MANYLIGHTS_SOURCE_DIR "/tests/data/points/cornell.points";

Selectors selectors_of(const std::string& points) {
    Selectors selectors;
    selectors.scene = "cornell";
    selectors.width = 64;
    selectors.height = 36;
    selectors.points = points;
    return selectors;
}

std::string refusal(const Selectors& selectors) {
    try {
        find_saved_points(selectors, load_scene("cornell", Detail::low));
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(SavedView, there_is_none_without_a_file) {
    const Scene scene = load_scene("cornell", Detail::low);
    EXPECT_FALSE(find_saved_points(selectors_of(""), scene));
    EXPECT_FALSE(find_saved_points(selectors_of(testing::TempDir() + "not-there-yet.points"), scene));
    const Selectors selectors = with_saved_view(selectors_of(""), std::nullopt);
    EXPECT_EQ(selectors.width, 64u);
    EXPECT_EQ(selectors.camera, "");
}

TEST(SavedView, the_file_s_camera_and_size_are_used) {
    const auto saved = find_saved_points(selectors_of(kFile), load_scene("cornell", Detail::low));
    ASSERT_TRUE(saved);
    const Selectors selectors = with_saved_view(selectors_of(kFile), saved);
    EXPECT_EQ(selectors.width, 31u);
    EXPECT_EQ(selectors.height, 17u);
    EXPECT_EQ(selectors.camera, "front");
}

TEST(SavedView, camera_and_size_may_be_given_where_they_agree) {
    Selectors selectors = selectors_of(kFile);
    selectors.camera = "front";
    selectors.width = 31;
    selectors.height = 17;
    selectors.size_given = true;
    EXPECT_EQ(refusal(selectors), "accepted");
    selectors.height = 18;
    EXPECT_EQ(refusal(selectors), "--size '31x18': must be 31x17, which --points '" + kFile + "' has, or left out");
    selectors = selectors_of(kFile);
    selectors.camera = "low";
    EXPECT_EQ(refusal(selectors), "--camera 'low': must be 'front', which --points '" + kFile + "' is of, or left out");
}

TEST(SavedView, the_scene_and_its_detail_must_agree) {
    Selectors selectors = selectors_of(kFile);
    selectors.scene = "bars";
    EXPECT_EQ(refusal(selectors), "points \"" + kFile + "\": scene 'cornell': must be 'bars', the one selected");
    selectors = selectors_of(kFile);
    selectors.detail = Detail::low;
    EXPECT_EQ(refusal(selectors),
              "points \"" + kFile + "\": scene 'cornell': must be 'cornell (low detail)', the one selected");
}

TEST(SavedView, scenes_from_files_go_by_their_own_name) {
    Selectors selectors;
    selectors.scene = "some/folder/town.glb";
    selectors.detail = Detail::low;
    EXPECT_EQ(scene_label(selectors), "town.glb");
}

TEST(SavedView, a_folder_that_is_not_there_is_refused_before_anything_is_drawn) {
    EXPECT_EQ(refusal(selectors_of("no/such/a.points")),
              "cannot write no/such/a.points: the folder no/such does not exist");
}

} // namespace
} // namespace manylights::lab::app
