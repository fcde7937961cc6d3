#include "reference/paper/slices.h"
#include "tests/unit/paper/cases.h"
#include "tests/unit/paper/reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace manylights::paper {
namespace {

// The corrected formula gives the edges of the talk's slide, which prints them to three figures.
TEST(Slices, CorrectedEdgesAreTheSlides) {
    constexpr float kSlide[] = {5.0f,  6.8f,  9.2f,   12.6f,  17.1f,  23.2f,  31.5f, 42.9f,
                                58.3f, 79.2f, 108.0f, 146.0f, 199.0f, 271.0f, 368.0f};
    SliceTable slices;
    slices.update({}, 16);
    ASSERT_EQ(slices.edges().size(), 17u);
    EXPECT_EQ(slices.edges()[0], 0.0f);
    EXPECT_EQ(slices.edges()[16], std::numeric_limits<float>::infinity());
    for (int i = 0; i < 15; ++i) EXPECT_NEAR(slices.edges()[i + 1], kSlide[i], kSlide[i] < 100 ? 0.06f : 0.6f) << i;
    EXPECT_EQ(slices.slice_of(4.999f), 0u);
    EXPECT_EQ(slices.slice_of(5.0f), 1u);
    EXPECT_EQ(slices.slice_of(1e30f), 15u);
}

// Listing 4 divides by slice_count - 1 where it should multiply: a depth between near and far never gets beyond
// slice 1.
TEST(Slices, PrintedListing4ReachesTwoSlices) {
    SliceTable slices;
    slices.update({.slice_formula = SliceFormula::listing4_as_printed}, 16);
    std::set<std::uint32_t> reached;
    for (float depth = 0.1f; depth < 1e6f; depth *= 1.01f) {
        reached.insert(slices.slice_of(depth));
        // The listing itself.
        const float scale = 1.0f / ((std::log(500.0f) - std::log(5.0f)) * (16 - 1.0f));
        const float bias = 1.0f - std::log(5.0f) * scale;
        const float slice = std::max(std::log(depth) * scale + bias, 0.0f);
        if (std::abs(depth - 5.0f) > 0.01f) {
            EXPECT_EQ(slices.slice_of(depth), std::min(int(slice), 15)) << depth;
        }
    }
    EXPECT_EQ(reached, (std::set<std::uint32_t>{0, 1}));
}

struct TableCase {
    Options options;
    std::uint32_t count;
};

std::vector<TableCase> table_cases() {
    std::vector<TableCase> cases;
    for (SliceFormula formula : {SliceFormula::corrected, SliceFormula::listing4_as_printed})
        for (std::uint32_t count : {1u, 2u, 3u, 16u, 128u})
            for (float far_edge : {500.0f, 5.0001f, 1e30f})
                cases.push_back({{.slice_far = far_edge, .slice_formula = formula}, count});
    return cases;
}

// Both sides, at and around every edge: the table in the pipeline and ml_slice in the shader.
TEST(Slices, TheQueryFindsTheSameSlice) {
    SliceTable slices;
    for (const TableCase& test : table_cases()) {
        slices.update(test.options, test.count);
        Buffers frame;
        frame.slice_edges = slices.edges();
        Reader reader(frame);
        MlView view{};
        view.slice_count = test.count;
        view.slice_scale = slices.guess_scale();
        view.slice_bias = slices.guess_bias();
        for (std::uint32_t i = 1; i < test.count; ++i) {
            float depth = slices.edges()[i];
            if (!std::isfinite(depth)) continue;
            for (int step = 0; step < 8; ++step) depth = std::nextafter(depth, 0.0f);
            for (int step = 0; step < 16; ++step, depth = std::nextafter(depth, 1e38f)) {
                const std::uint32_t slice = slices.slice_of(depth);
                EXPECT_EQ(reader.ml_slice(view, depth), slice) << depth;
                EXPECT_TRUE(slices.edges()[slice] <= depth && depth < slices.edges()[slice + 1]) << depth;
            }
        }
        for (float depth : {0.0f, 1e-40f, 0.1f, 3e38f}) EXPECT_EQ(reader.ml_slice(view, depth), slices.slice_of(depth));
    }
}

TEST(Slices, EverySliceOfTheCorrectedFormulaIsReached) {
    for (std::uint32_t count : {2u, 16u, 32u, 128u}) {
        SliceTable slices;
        slices.update({}, count);
        std::set<std::uint32_t> reached;
        std::uint32_t last = 0;
        for (float depth = 0.1f; depth < 1000.0f; depth *= 1.003f) {
            EXPECT_GE(slices.slice_of(depth), last);
            last = slices.slice_of(depth);
            reached.insert(last);
        }
        EXPECT_EQ(reached.size(), count);
    }
}

TEST(Slices, NegativeDepthsAreInTheFirst) {
    SliceTable slices;
    slices.update({}, 16);
    for (float depth : {-0.0f, -1.0f, -1e38f, -std::numeric_limits<float>::infinity()})
        EXPECT_EQ(slices.slice_of(depth), 0u);
    EXPECT_EQ(slices.slice_of(std::numeric_limits<float>::infinity()), 15u);
}

TEST(Slices, RefusesNonsense) {
    SliceTable slices;
    EXPECT_THROW(slices.update({}, 0), std::invalid_argument);
    EXPECT_THROW(slices.update({}, 129), std::invalid_argument);
    EXPECT_THROW(slices.update({.slice_near = 0.0f}, 16), std::invalid_argument);
    EXPECT_THROW(slices.update({.slice_near = 5.0f, .slice_far = 5.0f}, 16), std::invalid_argument);
}

} // namespace
} // namespace manylights::paper
