// What each technique does at the pinned points, in literal numbers: another machine has the same ones, or fails.

#include "lab/renderer/renderer.h"
#include "lab/renderer/scene_buffers.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"
#include "tests/unit/points/pinned_view.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace manylights::lab {
namespace {

/// Totals over the points, what the structure is made of, and the unions over the waves of 64 lanes.
struct Work {
    std::uint64_t tested, nodes, references;
    std::uint64_t visible_lights, structure_references, structure_bytes;
    std::uint64_t wave_tested, wave_affecting, wave_nodes, wave_checks;
    std::uint64_t wave_batches = 0;
    bool operator==(const Work&) const = default;
};

void PrintTo(const Work& work, std::ostream* out) {
    *out << "{" << work.tested << ", " << work.nodes << ", " << work.references << ", " << work.visible_lights << ", "
         << work.structure_references << ", " << work.structure_bytes << ", " << work.wave_tested << ", "
         << work.wave_affecting << ", " << work.wave_nodes << ", " << work.wave_checks << ", " << work.wave_batches
         << "}";
}

struct PinnedWork {
    const char* scene;
    const char* technique;
    Work work;
    const char* set = ""; ///< options besides the tiles' size, as --set takes them, with spaces between them
};

/// Tiles of 8 pixels, so that the small images have 4x3 of them; everything else as it is by default.
constexpr PinnedWork kPinnedWork[] = {
    {"canyon", "brute_force", {1990656, 0, 0, 4096, 0, 0, 49152, 510, 0, 0}},
    {"canyon", "exact", {3873, 0, 3873, 223, 3873, 19708, 510, 510, 0, 0}},
    {"canyon", "clustered", {37316, 486, 37316, 4096, 10865, 45128, 2999, 510, 52, 0}},
    {"canyon",
     "clustered",
     {20143, 486, 20143, 4096, 19330, 83788, 2182, 510, 91, 0},
     "slice_count=64 cell_test=tight loop=wave"},
    {"canyon", "tiled_light_trees", {27007, 24432, 27007, 4096, 6563, 99956, 2287, 510, 1604, 0}},
    {"canyon", "hybrid_light_trees", {28519, 5902, 28519, 4096, 10865, 116872, 2273, 510, 958, 0}},
    {"canyon", "depth_windows", {8141, 970, 23170, 4096, 6491, 71736, 819, 510, 104, 2042}},
    {"canyon", "depth_windows", {8141, 970, 15382, 4096, 846, 9536, 819, 510, 93, 843}, "depth=on"},
    {"canyon", "depth_windows_wave", {92836, 15036, 2636, 4096, 6491, 71736, 1761, 510, 282, 7, 45}, "wave=64"},
    {"canyon", "z_bins", {28831, 1670, 28831, 4096, 6561, 88096, 2413, 510, 300, 0}},
    {"canyon", "z_bins", {28787, 2152, 28787, 4096, 6561, 88288, 2413, 510, 373, 0}, "spacing=log summary=on"},
    {"canyon", "tiled", {171239, 486, 171239, 4096, 3205, 12988, 3205, 510, 12, 0}},
    {"canyon", "culling_2_5d", {109702, 486, 109702, 4096, 2060, 8408, 2060, 510, 12, 0}},
    {"canyon", "culling_2_5d", {24214, 972, 109702, 4096, 2060, 16688, 2060, 510, 24, 2060}, "variant=b"},
    {"canyon", "culling_2_5d", {24214, 972, 24214, 4096, 3425, 16884, 2060, 510, 81, 0}, "variant=c"},
    {"canyon", "hybrid_lighting", {28570, 486, 28570, 4096, 15380, 64244, 2787, 510, 45, 0}, "tiles=4x3"},
    {"canyon",
     "hybrid_lighting",
     {23661, 486, 23661, 4096, 15008, 126744, 2348, 510, 57, 0},
     "tiles=4x3 lists=linked division=view_uniform"},
    {"canyon", "tiled", {52305, 486, 52305, 4096, 2194, 8964, 4085, 510, 36, 0}, "tiles=5x4"},
    {"canyon", "light_linked_list", {15943, 486, 216386, 4096, 4169, 50096, 1670, 510, 12, 4169}},
    {"canyon",
     "light_linked_list",
     {5754, 486, 49507, 4096, 55252, 886160, 731, 510, 171, 49507},
     "resolution=full link_bytes=16"},
    {"canyon", "light_volumes", {69131, 0, 0, 4096, 0, 147456, 6316, 510, 0, 0}, "volume=rectangle"},
    {"canyon", "octree", {28570, 5346, 28570, 4096, 2607, 13296, 2787, 510, 272, 0}, "tiles=4x3"},
    {"canyon",
     "octree",
     {12915, 3888, 12915, 4096, 3049, 143876, 1281, 510, 370, 0},
     "tiles=12x9 nodes=dense division=view_uniform"},
    {"citadel", "brute_force", {1110016, 0, 0, 4096, 0, 0, 40960, 336, 0, 0}},
    {"citadel", "exact", {2221, 0, 2221, 191, 2221, 13100, 336, 336, 0, 0}},
    {"citadel", "clustered", {12584, 271, 12584, 3195, 12662, 52316, 1835, 336, 33, 0}},
    {"citadel",
     "clustered",
     {6066, 271, 6066, 3217, 22160, 95108, 1009, 336, 80, 0},
     "slice_count=64 cell_test=tight loop=wave"},
    {"citadel", "tiled_light_trees", {9872, 10136, 9872, 3195, 7690, 130064, 1128, 336, 888, 0}},
    {"citadel", "hybrid_light_trees", {10408, 1580, 10408, 3195, 12662, 167516, 1130, 336, 574, 0}},
    {"citadel", "depth_windows", {4007, 542, 7704, 3195, 7548, 65464, 549, 336, 47, 1026}},
    {"citadel", "depth_windows", {4007, 542, 6528, 3195, 559, 5560, 549, 336, 43, 559}, "depth=on"},
    {"citadel", "depth_windows_wave", {40537, 5124, 1655, 3195, 7548, 65464, 779, 336, 69, 11, 24}, "wave=64"},
    {"citadel", "z_bins", {9860, 614, 9860, 3195, 7680, 83148, 1186, 336, 204, 0}},
    {"citadel", "z_bins", {9882, 885, 9882, 3195, 7680, 83340, 1187, 336, 230, 0}, "spacing=log summary=on"},
    {"citadel", "tiled", {63464, 271, 63464, 3195, 1194, 4944, 1194, 336, 10, 0}},
    {"citadel", "culling_2_5d", {44237, 271, 44237, 3195, 866, 3632, 866, 336, 10, 0}},
    {"citadel", "culling_2_5d", {6616, 542, 44237, 3195, 866, 7136, 866, 336, 20, 866}, "variant=b"},
    {"citadel", "culling_2_5d", {6616, 542, 6616, 3195, 1975, 11084, 866, 336, 61, 0}, "variant=c"},
    {"citadel", "hybrid_lighting", {8743, 271, 8743, 3195, 10335, 44664, 1534, 336, 34, 0}, "tiles=4x3"},
    {"citadel",
     "hybrid_lighting",
     {6435, 271, 6435, 3195, 37755, 308720, 977, 336, 36, 0},
     "tiles=4x3 lists=linked division=view_uniform"},
    {"citadel", "tiled", {13443, 271, 13443, 3195, 1181, 4912, 1660, 336, 25, 0}, "tiles=5x4"},
    {"citadel", "light_linked_list", {5517, 271, 238531, 3195, 7643, 91784, 813, 336, 10, 5694}},
    {"citadel",
     "light_linked_list",
     {3248, 271, 7191, 3195, 38991, 625984, 503, 336, 97, 7191},
     "resolution=full link_bytes=16"},
    {"citadel", "light_volumes", {23761, 0, 0, 3195, 0, 115020, 4312, 336, 0, 0}, "volume=rectangle"},
    {"citadel", "octree", {8743, 3523, 8743, 3195, 1849, 10288, 1534, 336, 251, 0}, "tiles=4x3"},
    {"citadel",
     "octree",
     {4272, 2168, 4272, 3195, 1685, 138420, 650, 336, 269, 0},
     "tiles=12x9 nodes=dense division=view_uniform"},
    {"bars", "brute_force", {2093056, 0, 0, 4096, 0, 0, 49152, 701, 0, 0}},
    {"bars", "exact", {3966, 0, 3966, 391, 3966, 20080, 701, 701, 0, 0}},
    {"bars", "clustered", {37738, 511, 37738, 3250, 12897, 53256, 4346, 701, 74, 0}},
    {"bars",
     "clustered",
     {18000, 511, 18000, 3280, 23832, 101796, 2887, 701, 109, 0},
     "slice_count=64 cell_test=tight loop=wave"},
    {"bars", "tiled_light_trees", {29498, 24990, 29498, 3250, 6331, 101076, 3158, 701, 2104, 0}},
    {"bars", "hybrid_light_trees", {30933, 5872, 30933, 3250, 12897, 145304, 3130, 701, 1704, 0}},
    {"bars", "depth_windows", {8151, 1022, 22026, 3250, 6157, 53288, 1198, 701, 88, 2918}},
    {"bars", "depth_windows", {8151, 1022, 14740, 3250, 1226, 12088, 1198, 701, 88, 1226}, "depth=on"},
    {"bars", "depth_windows_wave", {138689, 20369, 4155, 3250, 6157, 53288, 2418, 701, 144, 8, 68}, "wave=64"},
    {"bars", "z_bins", {30701, 1763, 30701, 3250, 6323, 83464, 3306, 701, 347, 0}},
    {"bars", "z_bins", {30712, 2274, 30712, 3250, 6323, 83656, 3312, 701, 401, 0}, "spacing=log summary=on"},
    {"bars", "tiled", {235449, 511, 235449, 3250, 4053, 16380, 4053, 701, 12, 0}},
    {"bars", "culling_2_5d", {158156, 511, 158156, 3250, 2748, 11160, 2748, 701, 12, 0}},
    {"bars", "culling_2_5d", {20288, 1022, 158156, 3250, 2748, 22192, 2748, 701, 24, 2748}, "variant=b"},
    {"bars", "culling_2_5d", {20288, 1022, 20288, 3250, 5083, 23516, 2748, 701, 96, 0}, "variant=c"},
    {"bars", "hybrid_lighting", {27865, 511, 27865, 3250, 11022, 46812, 4973, 701, 85, 0}, "tiles=4x3"},
    {"bars",
     "hybrid_lighting",
     {15963, 511, 15963, 3250, 51780, 420920, 2830, 701, 119, 0},
     "tiles=4x3 lists=linked division=view_uniform"},
    {"bars", "tiled", {113538, 511, 113538, 3250, 4458, 18020, 6990, 701, 36, 0}, "tiles=5x4"},
    {"bars", "light_linked_list", {15740, 511, 299549, 3250, 5100, 61268, 2346, 701, 12, 5100}},
    {"bars",
     "light_linked_list",
     {6145, 511, 18835, 3250, 20344, 327632, 1054, 701, 178, 18835},
     "resolution=full link_bytes=16"},
    {"bars", "light_volumes", {60619, 0, 0, 3250, 0, 117000, 6322, 701, 0, 0}, "volume=rectangle"},
    {"bars", "octree", {27865, 5621, 27865, 3250, 5213, 24200, 4973, 701, 402, 0}, "tiles=4x3"},
    {"bars",
     "octree",
     {8480, 4088, 8480, 3250, 3573, 145972, 1448, 701, 615, 0},
     "tiles=12x9 nodes=dense division=view_uniform"},
    {"cornell", "brute_force", {1183744, 0, 0, 4096, 0, 0, 36864, 1333, 0, 0}},
    {"cornell", "exact", {1749, 0, 1749, 1284, 1749, 11212, 1333, 1333, 0, 0}},
    {"cornell", "clustered", {87802, 289, 87802, 4096, 7948, 33460, 5056, 1333, 24, 0}},
    {"cornell",
     "clustered",
     {44283, 289, 44283, 4096, 15851, 69872, 3548, 1333, 32, 0},
     "slice_count=64 cell_test=tight loop=wave"},
    {"cornell", "tiled_light_trees", {43654, 31884, 43654, 4096, 5352, 86920, 3538, 1333, 2332, 0}},
    {"cornell", "hybrid_light_trees", {43122, 30378, 43122, 4096, 7948, 121668, 3551, 1333, 2736, 0}},
    {"cornell", "depth_windows", {5666, 578, 50349, 4096, 5327, 44920, 2176, 1333, 40, 3849}},
    {"cornell", "depth_windows", {5666, 562, 34459, 4096, 2366, 20232, 2176, 1333, 38, 2366}, "depth=on"},
    {"cornell", "depth_windows_wave", {193653, 23508, 5742, 4096, 5327, 44920, 3213, 1333, 80, 24, 80}, "wave=64"},
    {"cornell", "z_bins", {73950, 2440, 73950, 4096, 5350, 88096, 3998, 1333, 162, 0}},
    {"cornell", "z_bins", {73944, 2729, 73944, 4096, 5350, 88288, 3998, 1333, 171, 0}, "spacing=log summary=on"},
    {"cornell", "tiled", {288754, 289, 288754, 4096, 4680, 18888, 4680, 1333, 9, 0}},
    {"cornell", "culling_2_5d", {204722, 289, 204722, 4096, 3367, 13636, 3367, 1333, 9, 0}},
    {"cornell", "culling_2_5d", {41182, 578, 204722, 4096, 3367, 27144, 3367, 1333, 18, 3367}, "variant=b"},
    {"cornell", "culling_2_5d", {41182, 578, 41182, 4096, 5093, 23556, 3367, 1333, 44, 0}, "variant=c"},
    {"cornell", "hybrid_lighting", {116011, 289, 116011, 4096, 7430, 31544, 6955, 1333, 20, 0}, "tiles=4x3"},
    {"cornell",
     "hybrid_lighting",
     {34548, 289, 34548, 4096, 27833, 229344, 4628, 1333, 48, 0},
     "tiles=4x3 lists=linked division=view_uniform"},
    {"cornell", "tiled", {132085, 289, 132085, 4096, 5448, 21980, 10924, 1333, 24, 0}, "tiles=5x4"},
    {"cornell", "light_linked_list", {35196, 289, 303776, 4096, 5236, 62900, 3056, 1333, 9, 5100}},
    {"cornell",
     "light_linked_list",
     {5079, 289, 11341, 4096, 12160, 196688, 2135, 1333, 109, 11341},
     "resolution=full link_bytes=16"},
    {"cornell", "light_volumes", {20230, 0, 0, 4096, 0, 147456, 5216, 1333, 0, 0}, "volume=rectangle"},
    {"cornell", "octree", {116011, 3179, 116011, 4096, 6113, 26036, 6955, 1333, 128, 0}, "tiles=4x3"},
    {"cornell",
     "octree",
     {11464, 2312, 11464, 4096, 4473, 149572, 2694, 1333, 295, 0},
     "tiles=12x9 nodes=dense division=view_uniform"},
};

class PinnedWorkTest : public TechniquesTest, public testing::WithParamInterface<PinnedWork> {};

const PinnedView& view_of(const PinnedWork& pinned) {
    for (const PinnedView& view : kPinnedViews)
        if (std::string(view.scene) == pinned.scene) return view;
    throw std::logic_error(std::string("no pinned view of ") + pinned.scene);
}

Work work_of(const std::vector<PixelRecord>& records, const TechniqueStats& stats, const WaveWork& waves) {
    Work work{0,
              0,
              0,
              stats.visible_lights,
              stats.references,
              stats.structure_bytes,
              waves.tested,
              waves.affecting,
              waves.nodes,
              waves.checks,
              waves.batches};
    for (const PixelRecord& record : records) {
        work.tested += record.tested;
        work.nodes += record.nodes;
        work.references += record.references;
    }
    return work;
}

OptionValues options_of(const PinnedWork& pinned) {
    const std::string name = pinned.technique;
    if (name == "brute_force" || name == "exact") return {};
    const std::string set = pinned.set;
    const bool has_tiles = name != "light_linked_list" && name != "light_volumes";
    OptionValues options;
    if (has_tiles && set.find("tiles=") == std::string::npos) options.push_back({"tile_size", "8"});
    std::istringstream words(set);
    for (std::string word; words >> word;) {
        const std::size_t sign = word.find('=');
        options.emplace_back(word.substr(0, sign), word.substr(sign + 1));
    }
    return options;
}

TEST_P(PinnedWorkTest, is_what_is_pinned) {
    const PinnedView& pinned = view_of(GetParam());
    const LoadedView view = load_view(pinned);
    const PointBuffer points = restore_points(device(), view.saved, material_records(view.scene));
    const Frame frame{view.scene, view.saved.camera, view.saved.width, view.saved.height, view.lights, points};
    const std::unique_ptr<Technique> technique = make_technique(device(), GetParam().technique, options_of(GetParam()));
    technique->prepare(frame);
    const std::vector<PixelRecord> records = technique->record(frame);
    EXPECT_EQ(light_set_hash(records), pinned.light_set_hash) << std::hex << light_set_hash(records);
    EXPECT_EQ(work_of(records, technique->stats(), technique->waves(frame).lanes_64), GetParam().work);
}

INSTANTIATE_TEST_SUITE_P(Views, PinnedWorkTest, testing::ValuesIn(kPinnedWork), [](const auto& pinned) {
    std::string name = std::string(pinned.param.scene) + "_" + pinned.param.technique + "_" + pinned.param.set;
    std::ranges::replace_if(
        name, [](char c) { return c == '=' || c == ' '; }, '_');
    return name;
});

class SavedPointsTest : public TechniquesTest {};

// Sky included, which a saved view only implies.
TEST_F(SavedPointsTest, restored_points_are_the_drawn_ones_bit_for_bit) {
    const Scene scene = load_scene("cornell", Detail::low);
    const Camera& camera = scene.cameras.front();
    const PointBuffer drawn = Renderer(device(), scene).render_points(camera, 47, 33);
    const SavedPoints saved = save_points("cornell", camera, drawn);
    EXPECT_GT(saved.points.size(), 100u);
    EXPECT_LT(saved.points.size(), std::size_t{47 * 33}) << "no sky to test";
    EXPECT_EQ(broken_material(saved, scene.materials.size()), "");
    const PointBuffer restored = restore_points(device(), saved, material_records(scene));
    EXPECT_EQ(restored.width(), 47u);
    EXPECT_EQ(restored.height(), 33u);
    const auto words = [](const gpu::Buffer& buffer) { return buffer.download<std::uint32_t>(); };
    EXPECT_EQ(words(restored.positions()), words(drawn.positions()));
    EXPECT_EQ(words(restored.normals()), words(drawn.normals()));
    EXPECT_EQ(words(restored.materials()), words(drawn.materials()));
}

TEST_F(SavedPointsTest, what_the_renderer_draws_keeps_the_rules) {
    for (const SceneInfo& info : builtin_scenes()) {
        const Scene scene = load_scene(info.name, Detail::low);
        Renderer renderer(device(), scene);
        std::vector<Camera> cameras = scene.cameras;
        cameras.insert(cameras.end(), scene.path.begin(), scene.path.end());
        for (const Camera& camera : cameras) {
            const SavedPoints saved = save_points(info.name, camera, renderer.render_points(camera, 160, 90));
            EXPECT_EQ(broken_rule(saved), "") << info.name << " " << camera.name;
        }
    }
}

} // namespace
} // namespace manylights::lab
