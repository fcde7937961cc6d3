// Each pixel's perfect list: what it tests is what affects, whatever bands the lists come in.

#include "lab/techniques/exact/list_bands.h"
#include "lab/techniques/shading_pass.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kRecordCode[] =
#include "exact_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "exact_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "exact_log.comp.inc"
    ;

class ExactTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const Frame& frame) {
        std::unique_ptr<Technique> technique = make_technique(device(), "exact", {});
        technique->prepare(frame);
        return technique;
    }
};

} // namespace

TEST_F(ExactTest, tests_what_affects_and_nothing_else) {
    const View view = made_view(device(), 97, 60, 900);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
    const std::vector<PixelRecord> got = records_of(device(), {"", "exact", {}}, view.frame());
    for (std::size_t pixel = 0; pixel < got.size(); ++pixel) {
        ASSERT_EQ(got[pixel].tested, truth[pixel].affecting);
        ASSERT_EQ(got[pixel].references, truth[pixel].affecting);
        ASSERT_EQ(got[pixel].nodes, 0u);
    }
}

TEST_F(ExactTest, waves_test_the_exact_union) {
    for (const std::uint32_t width : {1u, 7u, 47u, 130u}) {
        const View view = made_view(device(), width, 61, 900);
        const WaveSummary summary = prepared(view.frame())->waves(view.frame());
        const std::unique_ptr<Technique> brute_force = make_technique(device(), "brute_force", {});
        brute_force->prepare(view.frame());
        WaveSummary truth = brute_force->waves(view.frame());
        truth.lanes_64.tested = truth.lanes_64.affecting;
        truth.lanes_32.tested = truth.lanes_32.affecting;
        EXPECT_EQ(summary.lanes_64, truth.lanes_64) << width;
        EXPECT_EQ(summary.lanes_32, truth.lanes_32) << width;
        EXPECT_GT(summary.lanes_64.tested, 0u);
    }
}

TEST_F(ExactTest, reports_its_lists_and_no_build) {
    const View view = made_view(device(), 48, 33, 900);
    const std::unique_ptr<Technique> technique = prepared(view.frame());
    const PointLists lists = find_point_lists(view.frame(), view.positions);
    const TechniqueStats& stats = technique->stats();
    EXPECT_EQ(stats.references, lists.lights.size());
    EXPECT_EQ(stats.structure_bytes, 48 * 33 * 8 + 4 * lists.lights.size());
    EXPECT_EQ(stats.visible_lights, std::set(lists.lights.begin(), lists.lights.end()).size());
    EXPECT_TRUE(stats.build_ms.empty());
    EXPECT_TRUE(technique->classify(view.frame()).empty());
}

TEST_F(ExactTest, takes_the_lists_of_the_frame) {
    const View view = made_view(device(), 40, 30, 300);
    PointLists lists = find_point_lists(view.frame(), view.positions);
    std::ranges::fill(lists.lights, 0u); // the right lengths, and the wrong lights
    Frame frame = view.frame();
    frame.lists = &lists;
    const std::vector<PixelRecord> records = prepared(frame)->record(frame);
    EXPECT_TRUE(std::ranges::all_of(
        records, [](const PixelRecord& record) { return record.affecting == 0 || record.affecting == record.tested; }));
    EXPECT_EQ(summarize(records).references_mean * static_cast<double>(summarize(records).shaded),
              static_cast<double>(lists.lights.size()));
    EXPECT_FALSE(compare(records_of(device(), kBruteForce, frame), records, 40).exact());
    lists.first.pop_back();
    EXPECT_THROW(prepared(frame), std::invalid_argument);
}

// Bands of a few rows, that of a row which alone has more than the limit, and one for all.
TEST_F(ExactTest, does_not_depend_on_bands) {
    const View view = made_view(device(), 47, 33, 900);
    const Frame frame = view.frame();
    const PointLists lists = find_point_lists(frame, view.positions);
    const FrameLights lights(device(), frame);
    const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, frame);
    const WaveSummary waves = prepared(frame)->waves(frame);
    ShadingPass pass(device(), {"bands", kRecordCode, kShadeCode, kLogCode, 2}, LightSplit::none);
    for (const std::uint64_t bytes : {std::uint64_t{4}, std::uint64_t{4000}, kListBytes}) {
        const ListBands bands(device(), lists, view.width, view.height, bytes);
        EXPECT_EQ(bands.bands().size() == 1, bytes == kListBytes);
        EXPECT_EQ(bands.bands().size() == view.height, bytes == 4);
        for (const PassBand& band : bands.bands())
            EXPECT_TRUE(band.row_count == 1 || band.structure[1]->bytes() <= bytes);
        const VerifyResult result = compare(truth, pass.record(frame, lights, bands.bands()), view.width);
        EXPECT_EQ(result.wrong_pixels, 0u) << bytes << " bytes, first at " << result.first_x << ", " << result.first_y;
        EXPECT_EQ(pass.waves(frame, lights, bands.bands()), waves) << bytes << " bytes";
    }
}

} // namespace manylights::lab
